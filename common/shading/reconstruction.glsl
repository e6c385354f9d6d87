// Hasan 2006 section 3.6: each of a pixel's 2x2 sub-samples takes the indirect value of the closest view sample; then
// direct and indirect are box-filtered apart. Same order of sums as the CPU twin, so the results are equal bit by bit.
#include "common/gpu/item_index.glsl"

layout(local_size_x = 64) in;

// Rows of one slab, except for indirect: closest holds pixel numbers of the whole image. Texels, because a software
// rasteriser reads storage blocks very slowly.
layout(binding = 0) uniform samplerBuffer direct;
layout(binding = 1) uniform usamplerBuffer closest;  // one texel a pixel: its four sub-samples
layout(binding = 2) uniform samplerBuffer indirect;
layout(std430, binding = 3) writeonly buffer DirectImage { vec4 direct_image[]; };
layout(std430, binding = 4) writeonly buffer IndirectImage { vec4 indirect_image[]; };

uniform uint pixel_count;
uniform uint image_width;

vec3 indirect_of(uint source) {
  return source == 0xffffffffu ? vec3(0.0) : texelFetch(indirect, int(source)).rgb;
}

vec3 direct_of(uint subsample) { return texelFetch(direct, int(subsample)).rgb; }

void main() {
  uint i = item_index();
  if (i >= pixel_count) return;
  uint top = (i / image_width) * 4u * image_width + (i % image_width) * 2u;
  uint bottom = top + 2u * image_width;
  uvec4 from = texelFetch(closest, int(i));
  precise vec3 d = ((direct_of(top) + direct_of(top + 1u)) + (direct_of(bottom) + direct_of(bottom + 1u))) * 0.25;
  precise vec3 n = ((indirect_of(from.x) + indirect_of(from.y)) + (indirect_of(from.z) + indirect_of(from.w))) * 0.25;
  direct_image[i] = vec4(d, 0.0);
  indirect_image[i] = vec4(n, 0.0);
}
