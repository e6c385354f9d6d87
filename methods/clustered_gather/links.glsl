// Equation 3, outer sum: the interpolated irradiance of a pixel times its albedo. A texel holds two links: cluster and
// weight of each.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
layout(binding = 0) uniform usamplerBuffer links;
layout(binding = 1) uniform samplerBuffer irradiance;
layout(binding = 2) uniform samplerBuffer albedo;
layout(std430, binding = 3) writeonly buffer Indirect { vec4 indirect[]; };
uniform uint pixels;
uniform uint texels_per_pixel;

void main() {
  uint p = item_index();
  if (p >= pixels) return;
  vec3 sum = vec3(0.0f);
  int begin = int(p * texels_per_pixel), end = begin + int(texels_per_pixel);
  for (int i = begin; i < end; ++i) {
    uvec4 two = texelFetch(links, i);
    sum += uintBitsToFloat(two.y) * texelFetch(irradiance, int(two.x)).rgb;
    sum += uintBitsToFloat(two.w) * texelFetch(irradiance, int(two.z)).rgb;
  }
  indirect[p] = vec4(sum * texelFetch(albedo, int(p)).rgb, 0.0f);
}
