// Textures and framebuffers, only the kinds relight needs.
#pragma once

#include <cstdint>
#include <vector>

#include "common/gpu/object.h"

namespace relight::gpu {

class Texture {
 public:
  Texture() = default;
  // Nearest-neighbour lookup, clamped at the border. `internal_format` as in glTexStorage2D, e.g. GL_RGBA32F.
  // Each throws Error if the driver cannot allocate it.
  static Texture image_2d(int width, int height, uint32_t internal_format);
  static Texture cube(int size, uint32_t internal_format);
  // 32-bit float depth: `layers` square maps of size x size (a GL_TEXTURE_2D_ARRAY).
  static Texture depth_maps(int size, int layers);

  void bind(int unit) const;
  int width() const { return width_; }
  int height() const { return height_; }
  int layers() const { return layers_; }  // of an array or cube; 0 for a plain 2-D texture
  uint32_t id() const { return object_.id(); }

 private:
  Texture(Object object, int width, int height, int layers)
      : object_(std::move(object)), width_(width), height_(height), layers_(layers) {}
  Object object_;
  int width_ = 0, height_ = 0;
  int layers_ = 0;  // 0: a plain 2-D texture
};

class Framebuffer {
 public:
  Framebuffer();
  // Attach before bind(); `layer` of an array or cube.
  void attach_depth(const Texture& texture, int layer) const;
  void attach_color(const Texture& texture, int layer = 0) const;
  // Binds for drawing with a viewport of the whole texture. Throws Error if it is not complete.
  void bind(int width, int height) const;
  uint32_t id() const { return object_.id(); }

 private:
  Object object_;
};

}  // namespace relight::gpu
