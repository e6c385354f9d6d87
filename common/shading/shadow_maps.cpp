#include "common/shading/shadow_maps.h"

#include <glad/gl.h>

#include "common/run/error.h"

namespace relight {
namespace {

// Largest distance, in units of the slope per texel that glPolygonOffset knows (the larger of the two partial
// derivatives), between the depth at a texel's centre and anywhere in the texel: half a texel in x and in y.
// The rest covers the rounding of the slope itself.
constexpr float slope_bias = 1.0f + 1.0f / 64.0f;

// Puts back what other stages expect, even if drawing throws.
class DepthState {
 public:
  DepthState() {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glDisable(GL_CULL_FACE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-slope_bias, 0.0f);  // away from the light: depth is reversed
  }
  ~DepthState() {
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDisable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(0.0f, 0.0f);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
  }
  DepthState(const DepthState&) = delete;
  DepthState& operator=(const DepthState&) = delete;
};

}  // namespace

ShadowMaps::ShadowMaps(const Scene& scene, int size)
    : size_(size),
      geometry_(scene),
      program_(gpu::Program::graphics("common/shading/shadow_map_vertex.glsl", "")) {
  if (size < 1) fail("shadow map size {}: must be at least 1", size);
}

LightFrame ShadowMaps::render(const Emitter& light) {
  const LightFrame frame = light.is_directional()
                               ? parallel_frame(light, geometry_.bounds(), size_)
                               : light_frame(light, geometry_.reach(light.position()), size_);
  if (maps_.layers() < frame.faces) {
    maps_ = {};  // free the smaller one first
    maps_ = gpu::Texture::depth_maps(size_, frame.faces);
  }
  const DepthState state;
  program_.use();
  program_.set("light_position", frame.position);
  program_.set("tan_half", frame.tan_half);
  program_.set("near_depth", frame.near);
  program_.set("parallel", frame.parallel ? 1 : 0);
  for (int i = 0; i < frame.faces; ++i) {
    const ShadowFace face = frame.face(i);
    program_.set("face_right", face.right);
    program_.set("face_up", face.up);
    program_.set("face_forward", face.forward);
    framebuffer_.attach_depth(maps_, i);
    framebuffer_.bind(size_, size_);
    const float infinitely_far = 0.0f;
    glClearBufferfv(GL_DEPTH, 0, &infinitely_far);
    geometry_.draw(frame, face);
  }
  return frame;
}

void ShadowMaps::bind(const gpu::Program& reader, const LightFrame& frame, float position_error) const {
  maps_.bind(0);
  reader.set("shadow_maps", 0);
  reader.set("shadow_faces", frame.faces);
  reader.set("shadow_parallel", frame.parallel ? 1 : 0);
  reader.set("shadow_origin", frame.position);
  reader.set("shadow_axis_x", frame.axes[0]);
  reader.set("shadow_axis_y", frame.axes[1]);
  reader.set("shadow_axis_z", frame.axes[2]);
  reader.set("shadow_tan_half", frame.tan_half);
  reader.set("shadow_near", frame.near);
  reader.set("shadow_map_size", size_);
  reader.set("shadow_position_error", position_error);
}

int64_t ShadowMaps::bytes() const { return geometry_.bytes() + int64_t{4} * size_ * size_ * maps_.layers(); }

}  // namespace relight
