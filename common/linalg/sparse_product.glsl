// Sparse matrix times vector, one row an invocation: row-based form (Hasan 2006 section 5, "Comparison with row-based
// multiplication"). Rows of this slab only; each output is scaled by the row's RGB factor (the diffuse albedo k_d times
// the step of quantised weights).
// Entries lie in groups of sixteen: texels of columns (COLUMN_BITS 16 or 32), then texels of weights.
#include "common/gpu/item_index.glsl"
#include "common/linalg/stored_weights.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer GroupStart { uint group_start[]; };
layout(binding = 1) uniform usamplerBuffer groups;
layout(binding = 2) uniform samplerBuffer x;
layout(std430, binding = 3) readonly buffer Scale { vec4 row_scale[]; };
layout(std430, binding = 4) writeonly buffer Result { vec4 y[]; };
uniform uint first_row;
uniform uint rows;

const int column_texels = COLUMN_BITS / 8, weight_texels = 16 / texel_weights;
const int group_texels = column_texels + weight_texels;

// Columns [4 g, 4 g + 4) of a group.
uvec4 columns_of(int group, int g) {
#if COLUMN_BITS == 16
  uvec4 texel = texelFetch(groups, group + g / 2);
  uvec2 pairs = g % 2 == 0 ? texel.xy : texel.zw;
  return uvec4(pairs.x & 0xffffu, pairs.x >> 16, pairs.y & 0xffffu, pairs.y >> 16);
#else
  return texelFetch(groups, group + g);
#endif
}

void main() {
  uint local_row = item_index();
  if (local_row >= rows) return;
  vec3 sum = vec3(0.0f);
  int end = int(group_start[local_row + 1u]) * group_texels;
  for (int at = int(group_start[local_row]) * group_texels; at < end; at += group_texels) {
    for (int t = 0; t < weight_texels; ++t) {
      uvec4 texel = texelFetch(groups, at + column_texels + t);
      for (int g = 0; g < texel_weights / 4; ++g) {
        vec4 w = stored_weights(texel, g);
        uvec4 c = columns_of(at, t * texel_weights / 4 + g);
        for (int i = 0; i < 4; ++i) sum += w[i] * texelFetch(x, int(c[i])).rgb;
      }
    }
  }
  y[first_row + local_row] = vec4(sum * row_scale[first_row + local_row].rgb, 0.0f);
}
