// One quad a block: its corners on the picture, or outside of the view if its wavelet light is culled (Hasan 2006
// section 5, last paragraph of "Image-based transport").
#include "common/linalg/culling.glsl"
struct Quad {
  uint corner, size, texel;  // x | y << 16: on the picture, of the block, in the atlas
  uint column;
  float step, origin;  // weight = step * (texel + origin)
  float norm;
  float padding;
};
layout(std430, binding = 0) readonly buffer Quads { Quad quads[]; };
layout(std430, binding = 1) readonly buffer Vector { vec4 x[]; };
uniform vec2 picture_size;
flat out vec3 light_step;
flat out float origin;
flat out ivec2 to_texel;  // added to a pixel

ivec2 unpack(uint xy) { return ivec2(xy & 0xffffu, xy >> 16); }

void main() {
  Quad quad = quads[gl_InstanceID];
  vec3 light = x[quad.column].rgb;
  ivec2 corner = unpack(quad.corner), size = unpack(quad.size);
  light_step = quad.step * light;
  origin = quad.origin;
  to_texel = unpack(quad.texel) - corner;
  if (is_culled(light, quad.norm, cull_threshold)) {
    if (gl_VertexID == 0) {
      atomicAdd(culled_blocks, 1u);
      atomicAdd(culled_weights, uint(size.x * size.y));
    }
    gl_Position = vec4(-10.0f, 0.0f, 0.0f, 1.0f);
    return;
  }
  vec2 at = vec2(corner + size * ivec2(gl_VertexID & 1, gl_VertexID >> 1));
  gl_Position = vec4(2.0f * at / picture_size - 1.0f, 0.0f, 1.0f);
}
