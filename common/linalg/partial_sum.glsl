// target[pixel_at[i]] += source[i] for the places of a partial picture that are a pixel (partial_picture.h), one an
// invocation; no pixel has two places.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Source { vec4 source[]; };
layout(std430, binding = 1) readonly buffer Places { uint pixel_at[]; };
layout(std430, binding = 2) buffer Target { vec4 target[]; };
uniform uint count;

void main() {
  uint i = item_index();
  if (i >= count || pixel_at[i] == 0xffffffffu) return;
  target[pixel_at[i]] += source[i];
}
