// means[j] = mean of the light of a gather sample's four points (light_points.h); the same order of sums as the CPU's.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) writeonly buffer Means { vec4 means[]; };
uniform uint count;

void main() {
  uint j = item_index();
  if (j >= count) return;
  means[j] = 0.25 * ((points[4u * j] + points[4u * j + 1u]) + (points[4u * j + 2u] + points[4u * j + 3u]));
}
