#include "common/gpu/item_index.glsl"
layout(local_size_x = LOCAL_SIZE) in;
layout(std430, binding = 0) buffer Values { float values[]; };
uniform uint count;

void main() {
  uint i = item_index();
  if (i < count) values[i] = values[i] * 2.0;
}
