// A shader-storage (or vertex, index) buffer with its size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/gpu/object.h"

namespace relight::gpu {

class Buffer {
 public:
  Buffer() = default;
  // `data` null: contents undefined; see clear(). Throws Error if the driver cannot allocate it.
  explicit Buffer(int64_t bytes, const void* data = nullptr);
  template <typename T>
  static Buffer from(const std::vector<T>& v) {
    return Buffer(static_cast<int64_t>(v.size() * sizeof(T)), v.data());
  }
  ~Buffer() = default;
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  // Binds all of it, which must fit Context::max_storage_block_bytes().
  void bind_storage(int binding) const;
  // Binds a part; offset must be a multiple of storage_alignment().
  void bind_storage(int binding, int64_t offset, int64_t bytes) const;
  static int64_t storage_alignment();

  void clear() const;                         // all bytes zero
  void copy_from(const Buffer& other) const;  // of the same size
  void upload(int64_t offset, int64_t bytes, const void* data) const;
  void download(void* out, int64_t bytes, int64_t offset = 0) const;  // waits for the GPU
  template <typename T>
  std::vector<T> download() const {
    std::vector<T> v(static_cast<size_t>(bytes_) / sizeof(T));
    download(v.data(), static_cast<int64_t>(v.size() * sizeof(T)));
    return v;
  }
  int64_t bytes() const { return bytes_; }
  uint32_t id() const { return object_.id(); }

 private:
  Object object_;
  int64_t bytes_ = 0;
};

}  // namespace relight::gpu
