// Sparse matrix with RGB elements times RGB vector, channel by channel, one row an invocation. Rows of this
// slab only.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
struct Entry {
  uint column;
  float r, g, b;
};
layout(std430, binding = 0) readonly buffer RowStart { uint row_start[]; };
layout(std430, binding = 1) readonly buffer Entries { Entry entries[]; };
layout(std430, binding = 2) readonly buffer Vector { vec4 x[]; };
layout(std430, binding = 3) writeonly buffer Result { vec4 y[]; };
uniform uint first_row;
uniform uint rows;

void main() {
  uint local_row = item_index();
  if (local_row >= rows) return;
  vec3 sum = vec3(0.0f);
  uint end = row_start[local_row + 1u];
  for (uint e = row_start[local_row]; e < end; ++e) {
    Entry entry = entries[e];
    sum += vec3(entry.r, entry.g, entry.b) * x[entry.column].rgb;
  }
  y[first_row + local_row] = vec4(sum, 0.0f);
}
