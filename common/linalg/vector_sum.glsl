// target += source, one element an invocation.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Source { vec4 source[]; };
layout(std430, binding = 1) buffer Target { vec4 target[]; };
uniform uint count;

void main() {
  uint i = item_index();
  if (i < count) target[i] += source[i];
}
