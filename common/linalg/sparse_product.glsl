// Sparse matrix times vector, one row an invocation: row-based form (Hasan 2006 section 5, "Comparison with row-based
// multiplication"). Rows of this slab only; each output is scaled by the row's RGB factor (the diffuse albedo k_d times
// the step of quantised weights).
// Entries lie in groups of four: COLUMN_BITS (16 or 32) bits a column, then WEIGHT_BITS (8, 16: signed integers; 32:
// float) bits a weight.
#include "common/gpu/item_index.glsl"
#include "common/linalg/stored_weights.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer GroupStart { uint group_start[]; };
layout(std430, binding = 1) readonly buffer Words { uint words[]; };
layout(std430, binding = 2) readonly buffer Vector { vec4 x[]; };
layout(std430, binding = 3) readonly buffer Scale { vec4 row_scale[]; };
layout(std430, binding = 4) writeonly buffer Result { vec4 y[]; };
uniform uint first_row;
uniform uint rows;

const uint column_words = uint(COLUMN_BITS) / 8u;
const uint group_words = column_words + uint(WEIGHT_BITS) / 8u;

uvec4 columns_of_group(uint at) {
#if COLUMN_BITS == 16
  return uvec4(words[at] & 0xffffu, words[at] >> 16, words[at + 1u] & 0xffffu, words[at + 1u] >> 16);
#else
  return uvec4(words[at], words[at + 1u], words[at + 2u], words[at + 3u]);
#endif
}

void main() {
  uint local_row = item_index();
  if (local_row >= rows) return;
  vec3 sum = vec3(0.0f);
  uint end = group_start[local_row + 1u] * group_words;
  for (uint at = group_start[local_row] * group_words; at < end; at += group_words) {
    uvec4 c = columns_of_group(at);
    vec4 w = STORED_WEIGHTS(words, at + column_words);
    sum += w.x * x[c.x].rgb + w.y * x[c.y].rgb + (w.z * x[c.z].rgb + w.w * x[c.w].rgb);
  }
  y[first_row + local_row] = vec4(sum * row_scale[first_row + local_row].rgb, 0.0f);
}
