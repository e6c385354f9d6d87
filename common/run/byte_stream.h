// Arrays as bytes, one after the other, for the artefact cache. The bytes are those of this machine; a cache
// key names the sizes of what is stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "common/run/error.h"

namespace relight {

// Appends the number of values and the values.
template <typename T>
void append_values(std::vector<std::byte>& out, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const uint64_t count = values.size();
  const size_t at = out.size(), bytes = values.size() * sizeof(T);
  out.resize(at + sizeof(count) + bytes);
  std::memcpy(out.data() + at, &count, sizeof(count));
  if (bytes > 0) std::memcpy(out.data() + at + sizeof(count), values.data(), bytes);
}

// Reads them back in the same order. `bytes` must outlive the reader.
class ByteReader {
 public:
  explicit ByteReader(const std::vector<std::byte>& bytes) : bytes_(bytes) {}
  // Throws Error if the bytes end before the values do.
  template <typename T>
  std::vector<T> next() {
    static_assert(std::is_trivially_copyable_v<T>);
    uint64_t count = 0;
    take(&count, sizeof(count));
    if (count > (bytes_.size() - at_) / sizeof(T)) fail("cached artefact: truncated after {} bytes", at_);
    std::vector<T> values(count);
    if (count > 0) take(values.data(), count * sizeof(T));
    return values;
  }

  bool at_end() const { return at_ == bytes_.size(); }

 private:
  void take(void* out, size_t n) {
    if (n > bytes_.size() - at_) fail("cached artefact: truncated after {} bytes", at_);
    std::memcpy(out, bytes_.data() + at_, n);
    at_ += n;
  }
  const std::vector<std::byte>& bytes_;
  size_t at_ = 0;
};

}  // namespace relight
