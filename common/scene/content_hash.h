// A 64-bit hash of bytes, for cache keys: fast, not cryptographic, the same on every machine of one byte
// order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "common/sampling/random.h"

namespace relight {

class ContentHash {
 public:
  void add_bytes(const void* data, size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    add_word(size);  // so that [a][b,c] and [a,b][c] differ
    for (; size >= 8; bytes += 8, size -= 8) add_word(load(bytes, 8));
    if (size > 0) add_word(load(bytes, size));
  }
  // Trivially copyable values without padding only: padding bytes would make equal values hash differently.
  template <typename T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_bytes(&value, sizeof(T));
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_bytes(values.data(), values.size() * sizeof(T));
  }
  uint64_t value() const { return mix64(state_); }

 private:
  static uint64_t load(const unsigned char* bytes, size_t size) {
    uint64_t word = 0;
    std::memcpy(&word, bytes, size);
    return word;
  }
  void add_word(uint64_t word) {
    state_ = mix64(state_ ^ (word * 0x9e3779b97f4a7c15ull)) + 0xd6e8feb86659fd93ull;
  }
  uint64_t state_ = 0x243f6a8885a308d3ull;
};

}  // namespace relight
