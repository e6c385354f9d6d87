// Renders the depth maps of one light at a time. Depth is reversed, near / d with d the depth along the
// face's axis: float's precision then is relative at any distance, and there is no far plane. In parallel
// projection it is linear, 1 in front of the scene and 0 behind it.
#pragma once

#include <cstdint>
#include <optional>

#include "common/gpu/program.h"
#include "common/gpu/texture.h"
#include "common/shading/light_frame.h"
#include "common/shading/shadow_geometry.h"

namespace relight {

class ShadowMaps {
 public:
  // size: texels a side. Throws Error if the GPU cannot take it.
  ShadowMaps(const Scene& scene, int size);
  // Renders all maps of the light; they stay valid until the next call. Returns how they are to be read.
  LightFrame render(const Emitter& light);
  // Binds the maps to texture unit 0 and sets the uniforms that shadow_map.glsl declares.
  void bind(const gpu::Program& reader, const LightFrame& frame, float position_error) const;
  int64_t bytes() const;

 private:
  int size_;
  ShadowGeometry geometry_;
  gpu::Program program_;
  gpu::Framebuffer framebuffer_;
  gpu::Texture maps_;
};

}  // namespace relight
