#include "reference/path_tracer_state.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include "common/run/atomic_file.h"
#include "common/run/error.h"

namespace relight {
namespace {

constexpr std::string_view magic = "relight path tracer state 1\n";

template <typename T>
void put(std::string& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  out.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <typename T>
void put_all(std::string& out, const std::vector<T>& values) {
  put(out, static_cast<uint64_t>(values.size()));
  out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

struct Reader {
  const std::filesystem::path& file;
  std::string_view rest;

  void take(void* out, size_t bytes) {
    if (rest.size() < bytes) fail("checkpoint '{}' is truncated; delete it to start anew", file.string());
    std::memcpy(out, rest.data(), bytes);
    rest.remove_prefix(bytes);
  }
  template <typename T>
  T next() {
    T value;
    take(&value, sizeof(T));
    return value;
  }
  template <typename T>
  std::vector<T> next_all() {
    const auto count = next<uint64_t>();
    if (count > rest.size() / sizeof(T))
      fail("checkpoint '{}' is truncated; delete it to start anew", file.string());
    std::vector<T> values(count);
    if (count > 0) take(values.data(), count * sizeof(T));
    return values;
  }
};

// FNV-1a: tells a damaged file, not a forged one.
uint64_t checksum(std::string_view bytes) {
  uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return hash;
}

}  // namespace

void save_state(const std::filesystem::path& file, const std::string& key, const PathTracerState& state) {
  std::string out(magic);
  put_all(out, std::vector<char>(key.begin(), key.end()));
  put(out, state.batches);
  put(out, state.rays);
  put(out, state.non_finite);
  put(out, state.seconds);
  put_all(out, state.paths);
  put_all(out, state.pixels);
  put_all(out, state.layers);
  put(out, checksum(out));
  write_text_atomically(file, out);
}

std::optional<PathTracerState> load_state(const std::filesystem::path& file, const std::string& key) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!std::string_view(bytes).starts_with(magic))
    fail("'{}' is not a checkpoint of this version; delete it or choose another folder", file.string());
  Reader reader{file, std::string_view(bytes).substr(magic.size())};
  const std::vector<char> found = reader.next_all<char>();
  if (std::string(found.begin(), found.end()) != key)
    fail(
        "checkpoint '{}' belongs to another run; delete it or choose another folder\n  there: {}\n  here:  "
        "{}",
        file.string(), std::string(found.begin(), found.end()), key);
  PathTracerState state;
  state.batches = reader.next<int>();
  state.rays = reader.next<int64_t>();
  state.non_finite = reader.next<int64_t>();
  state.seconds = reader.next<double>();
  state.paths = reader.next_all<int>();
  state.pixels = reader.next_all<PixelStatistics>();
  state.layers = reader.next_all<PixelStatistics>();
  const size_t checked = bytes.size() - reader.rest.size();
  const auto found_sum = reader.next<uint64_t>();
  if (found_sum != checksum(std::string_view(bytes).substr(0, checked)) || !reader.rest.empty())
    fail("checkpoint '{}' is damaged; delete it to start anew", file.string());
  return state;
}

}  // namespace relight
