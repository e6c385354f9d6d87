// Equation 3, inner sum: the radiance of a view cluster's gather samples, whose albedos hold their weights, one cluster
// an invocation.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer First { uint first[]; };
layout(binding = 1) uniform samplerBuffer radiance;
layout(std430, binding = 2) writeonly buffer Gathered { vec4 gathered[]; };
uniform uint clusters;

void main() {
  uint k = item_index();
  if (k >= clusters) return;
  vec3 sum = vec3(0.0f);
  int end = int(first[k + 1u]);
  for (int i = int(first[k]); i < end; ++i) sum += texelFetch(radiance, i).rgb;
  gathered[k] = vec4(sum, 0.0f);
}
