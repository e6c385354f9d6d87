// Sparse matrix times vector, one row an invocation: row-based form (Hasan 2006 section 5, "Comparison with row-based
// multiplication"). Rows of this slab only; each output is scaled by the row's RGB factor (the diffuse albedo k_d).
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
struct Entry { uint column; float value; };
layout(std430, binding = 0) readonly buffer RowStart { uint row_start[]; };
layout(std430, binding = 1) readonly buffer Entries { Entry entries[]; };
layout(std430, binding = 2) readonly buffer Vector { vec4 x[]; };
layout(std430, binding = 3) readonly buffer Scale { vec4 row_scale[]; };
layout(std430, binding = 4) writeonly buffer Result { vec4 y[]; };
uniform uint first_row;
uniform uint rows;

void main() {
  uint local_row = item_index();
  if (local_row >= rows) return;
  vec4 sum = vec4(0.0f);
  uint end = row_start[local_row + 1u];
  for (uint e = row_start[local_row]; e < end; ++e) sum += entries[e].value * x[entries[e].column];
  y[first_row + local_row] = sum * row_scale[first_row + local_row];
}
