// The culling threshold: epsilon times the root of the sum over the lights of (|light| x norm of its column)^2. One
// workgroup; a sum that is not finite gives a threshold that culls nothing.
layout(local_size_x = 256) in;
layout(std430, binding = 0) readonly buffer Norms { float squared_norm[]; };
layout(std430, binding = 1) readonly buffer Vector { vec4 x[]; };
layout(std430, binding = 6) writeonly buffer CullThreshold { float cull_threshold; };
uniform uint columns;
uniform float epsilon;
shared float sums[256];

void main() {
  uint lane = gl_LocalInvocationID.x;
  float sum = 0.0f;
  for (uint c = lane; c < columns; c += 256u) sum += squared_norm[c] * dot(x[c].rgb, x[c].rgb);
  sums[lane] = sum;
  for (uint half_size = 128u; half_size > 0u; half_size /= 2u) {
    barrier();
    if (lane < half_size) sums[lane] += sums[lane + half_size];
  }
  if (lane == 0u) cull_threshold = sums[0] < 3e38f ? epsilon * sqrt(sums[0]) : -1.0f;
}
