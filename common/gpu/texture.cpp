#include "common/gpu/texture.h"

#include <glad/gl.h>

#include "common/run/error.h"

namespace relight::gpu {
namespace {

Object new_texture(GLenum target) {
  Object object = create_object(ObjectKind::texture, target);
  glTextureParameteri(object.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(object.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(object.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(object.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return object;
}

void check_size(int width, int height) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (width < 1 || height < 1 || width > limit || height > limit) {
    fail("a texture of {} x {} was asked for; this GPU takes 1 to {} a side", width, height, limit);
  }
}

void check_allocated(int width, int height, int layers) {
  if (glGetError() != GL_NO_ERROR) {
    fail("the GPU could not allocate a texture of {} x {} x {}", width, height, layers);
  }
}

}  // namespace

Texture Texture::image_2d(int width, int height, uint32_t internal_format) {
  check_size(width, height);
  Object object = new_texture(GL_TEXTURE_2D);
  glTextureStorage2D(object.id(), 1, internal_format, width, height);
  check_allocated(width, height, 1);
  return Texture(std::move(object), width, height, 0);
}

Texture Texture::cube(int size, uint32_t internal_format) {
  check_size(size, size);
  Object object = new_texture(GL_TEXTURE_CUBE_MAP);
  glTextureStorage2D(object.id(), 1, internal_format, size, size);
  check_allocated(size, size, 6);
  return Texture(std::move(object), size, size, 6);
}

Texture Texture::depth_maps(int size, int layers) {
  check_size(size, size);
  Object object = new_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(object.id(), 1, GL_DEPTH_COMPONENT32F, size, size, layers);
  check_allocated(size, size, layers);
  return Texture(std::move(object), size, size, layers);
}

void Texture::bind(int unit) const { glBindTextureUnit(static_cast<GLuint>(unit), id()); }

Framebuffer::Framebuffer() : object_(create_object(ObjectKind::framebuffer)) {
  glNamedFramebufferDrawBuffer(id(), GL_NONE);
  glNamedFramebufferReadBuffer(id(), GL_NONE);
}

void Framebuffer::attach_depth(const Texture& texture, int layer) const {
  if (texture.layers() == 0) return glNamedFramebufferTexture(id(), GL_DEPTH_ATTACHMENT, texture.id(), 0);
  glNamedFramebufferTextureLayer(id(), GL_DEPTH_ATTACHMENT, texture.id(), 0, layer);
}

void Framebuffer::attach_color(const Texture& texture, int layer) const {
  if (texture.layers() == 0) {
    glNamedFramebufferTexture(id(), GL_COLOR_ATTACHMENT0, texture.id(), 0);
  } else {
    glNamedFramebufferTextureLayer(id(), GL_COLOR_ATTACHMENT0, texture.id(), 0, layer);
  }
  glNamedFramebufferDrawBuffer(id(), GL_COLOR_ATTACHMENT0);
  glNamedFramebufferReadBuffer(id(), GL_COLOR_ATTACHMENT0);
}

void Framebuffer::bind(int width, int height) const {
  const GLenum status = glCheckNamedFramebufferStatus(id(), GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) fail("GPU framebuffer is not complete (status 0x{:x})", status);
  glBindFramebuffer(GL_FRAMEBUFFER, id());
  glViewport(0, 0, width, height);
}

}  // namespace relight::gpu
