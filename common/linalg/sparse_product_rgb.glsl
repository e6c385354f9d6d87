// Sparse matrix with RGB elements times RGB vector, channel by channel, one row an invocation. Rows of this
// slab only.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer RowStart { uint row_start[]; };
layout(binding = 1) uniform usamplerBuffer entries;  // column, red, green, blue
layout(binding = 2) uniform samplerBuffer x;
layout(std430, binding = 3) writeonly buffer Result { vec4 y[]; };
uniform uint first_row;
uniform uint rows;

void main() {
  uint local_row = item_index();
  if (local_row >= rows) return;
  vec3 sum = vec3(0.0f);
  int end = int(row_start[local_row + 1u]);
  for (int e = int(row_start[local_row]); e < end; ++e) {
    uvec4 entry = texelFetch(entries, e);
    sum += uintBitsToFloat(entry.yzw) * texelFetch(x, int(entry.x)).rgb;
  }
  y[first_row + local_row] = vec4(sum, 0.0f);
}
