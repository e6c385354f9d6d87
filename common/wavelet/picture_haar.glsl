// The inverse transform of picture_haar.h and the factor of each pixel (k_d), one pixel an invocation. Texels, because
// a software rasteriser reads storage blocks very slowly.
#include "common/gpu/item_index.glsl"
layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer coefficients;
layout(binding = 1) uniform samplerBuffer factor;  // rgb; alpha: 1 = its tile is transformed
layout(std430, binding = 2) writeonly buffer Pixels { vec4 pixels[]; };
uniform uint pixel_count;
uniform int width;
uniform int height;

vec3 child(vec3 s, vec3 h, vec3 v, vec3 d, bool a, bool b) {
  return 0.5 * ((s + (a ? -h : h)) + ((b ? -v : v) + (a != b ? -d : d)));
}

void main() {
  uint n = item_index();
  if (n >= pixel_count) return;
  ivec2 p = ivec2(int(n) % width, int(n) / width);
  vec4 k = texelFetch(factor, int(n));
  ivec2 planes = ivec2(width, height) / 4;
  ivec2 tile = p / 4, at = p % 4;
  vec3 value;
  if (any(greaterThanEqual(p, planes * 4))) {
    value = texelFetch(coefficients, int(n)).rgb;
  } else if (k.a == 0.0) {
    ivec2 q = at * planes + tile;
    value = texelFetch(coefficients, q.y * width + q.x).rgb;
  } else {
    ivec2 node = at / 2;
    int origin = tile.y * width + tile.x, row = planes.y * width;
    vec3 s = texelFetch(coefficients, origin).rgb, h = texelFetch(coefficients, origin + planes.x).rgb;
    vec3 v = texelFetch(coefficients, origin + row).rgb, d = texelFetch(coefficients, origin + row + planes.x).rgb;
    s = child(s, h, v, d, node.x == 1, node.y == 1);
    int right = (2 + node.x) * planes.x, down = (2 + node.y) * row;
    h = texelFetch(coefficients, origin + right + node.y * row).rgb;
    v = texelFetch(coefficients, origin + node.x * planes.x + down).rgb;
    d = texelFetch(coefficients, origin + right + down).rgb;
    value = child(s, h, v, d, at.x % 2 == 1, at.y % 2 == 1);
  }
  pixels[n] = vec4(value * k.rgb, 0.0);
}
