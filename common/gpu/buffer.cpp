#include "common/gpu/buffer.h"

#include <glad/gl.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/run/error.h"

namespace relight::gpu {
namespace {

void check_range(const char* what, int64_t offset, int64_t bytes, int64_t size) {
  if (offset < 0 || bytes < 0 || offset > size - bytes) {
    throw std::logic_error(
        fmt::format("{}: bytes [{}, {}) of a buffer of {}", what, offset, offset + bytes, size));
  }
}

}  // namespace

Buffer::Buffer(int64_t bytes, const void* data) : object_(create_object(ObjectKind::buffer)), bytes_(bytes) {
  if (bytes < 0) throw std::logic_error("GPU buffer of negative size");
  // GL refuses empty storage; one unused vec4 keeps empty sample sets bindable.
  const int64_t allocated = std::max<int64_t>(bytes, 16);
  glNamedBufferStorage(object_.id(), allocated, bytes > 0 ? data : nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (glGetError() != GL_NO_ERROR) fail("the GPU could not allocate a buffer of {} bytes", bytes);
}

Buffer::Buffer(Buffer&& other) noexcept
    : object_(std::move(other.object_)), bytes_(std::exchange(other.bytes_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  object_ = std::move(other.object_);
  if (this != &other) bytes_ = std::exchange(other.bytes_, 0);
  return *this;
}

void Buffer::bind_storage(int binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding), id());
}

void Buffer::bind_storage(int binding, int64_t offset, int64_t bytes) const {
  check_range("bind_storage", offset, bytes, bytes_);
  if (bytes == 0) return bind_storage(binding);
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding), id(), offset, bytes);
}

int64_t Buffer::storage_alignment() {
  GLint alignment = 256;
  glGetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &alignment);
  return alignment;
}

void Buffer::clear() const {
  const uint32_t zero = 0;
  glClearNamedBufferData(id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

void Buffer::copy_from(const Buffer& other) const {
  if (other.bytes_ != bytes_)
    throw std::logic_error(fmt::format("copy_from: {} bytes into a buffer of {}", other.bytes_, bytes_));
  if (bytes_ > 0) glCopyNamedBufferSubData(other.id(), id(), 0, 0, bytes_);
}

void Buffer::upload(int64_t offset, int64_t bytes, const void* data) const {
  check_range("upload", offset, bytes, bytes_);
  if (bytes > 0) glNamedBufferSubData(id(), offset, bytes, data);
}

void Buffer::download(void* out, int64_t bytes, int64_t offset) const {
  check_range("download", offset, bytes, bytes_);
  if (bytes == 0) return;
  // Shaders may have written it; the barrier the spec asks for before glGetNamedBufferSubData.
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(id(), offset, bytes, out);
}

}  // namespace relight::gpu
