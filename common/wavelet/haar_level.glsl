// One level of the forward Haar transform in tree order (common/wavelet/haar.h): node i of `nodes` reads its four
// children's scaling coefficients and writes its own and the three details. The root's pass also writes index 0.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Source { vec4 source[]; };
layout(std430, binding = 1) writeonly buffer Target { vec4 target[]; };
layout(std430, binding = 2) writeonly buffer Coefficients { vec4 coefficients[]; };
uniform uint nodes;

void main() {
  uint i = item_index();
  if (i >= nodes) return;
  vec4 c0 = source[4u * i], c1 = source[4u * i + 1u], c2 = source[4u * i + 2u], c3 = source[4u * i + 3u];
  vec4 scaling = 0.5f * ((c0 + c1) + (c2 + c3));
  target[i] = scaling;
  coefficients[nodes + i] = 0.5f * ((c0 - c1) + (c2 - c3));
  coefficients[2u * nodes + i] = 0.5f * ((c0 + c1) - (c2 + c3));
  coefficients[3u * nodes + i] = 0.5f * ((c0 - c1) - (c2 - c3));
  if (nodes == 1u) coefficients[0] = scaling;
}
