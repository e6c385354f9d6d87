// The blended sums times each pixel's RGB factor, from the float target to the result.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
uniform sampler2D sums;
layout(std430, binding = 0) readonly buffer Scale { vec4 row_scale[]; };
layout(std430, binding = 1) writeonly buffer Result { vec4 y[]; };
uniform uint width;
uniform uint rows;

void main() {
  uint row = item_index();
  if (row >= rows) return;
  vec3 sum = texelFetch(sums, ivec2(row % width, row / width), 0).rgb;
  y[row] = vec4(sum * row_scale[row].rgb, 0.0f);
}
