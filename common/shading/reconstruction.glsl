// Hasan 2006 section 3.6: each of a pixel's 2x2 sub-samples takes the indirect value of the closest view sample; then
// direct and indirect are box-filtered apart. Same order of sums as the CPU twin, so the results are equal bit by bit.
#include "common/gpu/item_index.glsl"

layout(local_size_x = 64) in;

// Rows of one slab, except for indirect: closest holds pixel numbers of the whole image.
layout(std430, binding = 0) readonly buffer Direct { vec4 direct[]; };
layout(std430, binding = 1) readonly buffer Closest { uint closest[]; };
layout(std430, binding = 2) readonly buffer Indirect { vec4 indirect[]; };
layout(std430, binding = 3) writeonly buffer DirectImage { vec4 direct_image[]; };
layout(std430, binding = 4) writeonly buffer IndirectImage { vec4 indirect_image[]; };

uniform uint pixel_count;
uniform uint image_width;

vec3 indirect_of(uint subsample) {
  uint source = closest[subsample];
  return source == 0xffffffffu ? vec3(0.0) : indirect[source].rgb;
}

void main() {
  uint i = item_index();
  if (i >= pixel_count) return;
  uint top = (i / image_width) * 4u * image_width + (i % image_width) * 2u;
  uint bottom = top + 2u * image_width;
  precise vec3 d = ((direct[top].rgb + direct[top + 1u].rgb) + (direct[bottom].rgb + direct[bottom + 1u].rgb)) * 0.25;
  precise vec3 n = ((indirect_of(top) + indirect_of(top + 1u)) + (indirect_of(bottom) + indirect_of(bottom + 1u))) * 0.25;
  direct_image[i] = vec4(d, 0.0);
  indirect_image[i] = vec4(n, 0.0);
}
