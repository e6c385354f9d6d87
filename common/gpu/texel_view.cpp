#include "common/gpu/texel_view.h"

#include <glad/gl.h>

#include "common/run/error.h"

namespace relight::gpu {
namespace {

GLenum internal(TexelView::Format format) {
  using enum TexelView::Format;
  return format == rgba32f    ? GL_RGBA32F
         : format == rgba32ui ? GL_RGBA32UI
         : format == rgb32ui  ? GL_RGB32UI
                              : GL_R32UI;
}

int64_t texel_bytes(TexelView::Format format) {
  using enum TexelView::Format;
  return format == r32ui ? 4 : format == rgb32ui ? 12 : 16;
}

int64_t limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace

TexelView::TexelView(const Buffer& buffer, Format format, int64_t offset, int64_t bytes)
    : object_(create_object(ObjectKind::texture, GL_TEXTURE_BUFFER)) {
  const GLenum internal_format = internal(format);
  const int64_t texels = bytes / texel_bytes(format);
  if (texels > max_texels())
    fail("a view of {} texels was asked for; this GPU takes {} in a buffer texture", texels, max_texels());
  // GL refuses an empty range; empty buffers have an unused vec4.
  if (bytes == 0)
    glTextureBuffer(object_.id(), internal_format, buffer.id());
  else
    glTextureBufferRange(object_.id(), internal_format, buffer.id(), offset, bytes);
  if (glGetError() != GL_NO_ERROR)
    fail("the GPU could not view bytes [{}, {}) of a buffer", offset, offset + bytes);
}

void TexelView::bind(int unit) const { glBindTextureUnit(static_cast<GLuint>(unit), object_.id()); }

int64_t TexelView::alignment() { return limit(GL_TEXTURE_BUFFER_OFFSET_ALIGNMENT); }
int64_t TexelView::max_texels() { return limit(GL_MAX_TEXTURE_BUFFER_SIZE); }

}  // namespace relight::gpu
