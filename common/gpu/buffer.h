// A shader-storage (or vertex) buffer with its size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relight::gpu {

class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(int64_t bytes, const void* data = nullptr);
  template <typename T>
  static Buffer from(const std::vector<T>& v) {
    return Buffer(static_cast<int64_t>(v.size() * sizeof(T)), v.data());
  }
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  void bind_storage(int binding) const;
  void upload(int64_t offset, int64_t bytes, const void* data) const;
  void download(void* out, int64_t bytes, int64_t offset = 0) const;  // waits for the GPU
  template <typename T>
  std::vector<T> download() const {
    std::vector<T> v(static_cast<size_t>(bytes_) / sizeof(T));
    download(v.data(), static_cast<int64_t>(v.size() * sizeof(T)));
    return v;
  }
  int64_t bytes() const { return bytes_; }
  uint32_t id() const { return id_; }

 private:
  uint32_t id_ = 0;
  int64_t bytes_ = 0;
};

}  // namespace relight::gpu
