#include "methods/direct_to_indirect/artefact.h"

#include <cstring>
#include <type_traits>

#include <fmt/format.h>

#include "common/run/error.h"
#include "common/sampling/random.h"

namespace relight::direct_to_indirect {
namespace {

constexpr int precompute_version = 12;

template <typename T>
void append(std::vector<std::byte>& out, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const uint64_t count = values.size();
  const size_t at = out.size(), bytes = values.size() * sizeof(T);
  out.resize(at + sizeof(count) + bytes);
  std::memcpy(out.data() + at, &count, sizeof(count));
  if (bytes > 0) std::memcpy(out.data() + at + sizeof(count), values.data(), bytes);
}

class Reader {
 public:
  explicit Reader(const std::vector<std::byte>& bytes) : bytes_(bytes) {}
  template <typename T>
  std::vector<T> next() {
    uint64_t count = 0;
    take(&count, sizeof(count));
    if (count > (bytes_.size() - at_) / sizeof(T)) fail("cached artefact: truncated after {} bytes", at_);
    std::vector<T> values(count);
    if (count > 0) take(values.data(), count * sizeof(T));
    return values;
  }

 private:
  void take(void* out, size_t n) {
    if (n > bytes_.size() - at_) fail("cached artefact: truncated after {} bytes", at_);
    std::memcpy(out, bytes_.data() + at_, n);
    at_ += n;
  }
  const std::vector<std::byte>& bytes_;
  size_t at_ = 0;
};

uint64_t hash_of(const std::vector<uint8_t>& mask) {
  uint64_t hash = mask.size();
  for (size_t i = 0; i < mask.size(); ++i)
    if (mask[i]) hash = hash_combine(hash, i);
  return hash;
}

std::string words(const glm::vec3& v) { return fmt::format("({},{},{})", v.x, v.y, v.z); }

}  // namespace

std::string cache_key(const PrepareContext& context) {
  return fmt::format("{};wanted={:016x};{}", view_key(context), hash_of(context.buffer.wanted),
                     context.knobs.precompute_key());
}

std::string view_key(const PrepareContext& context) {
  const View& view = context.buffer.view;
  const Camera& camera = view.camera;
  return fmt::format(
      "version={};layout={},{},{};scene={:016x};view={}x{};eye={};target={};up={};fov={};seed={}",
      precompute_version, sizeof(SurfaceSample), sizeof(SparseEntry), sizeof(SparseEntryRgb),
      context.scene.content_hash, view.width, view.height, words(camera.eye), words(camera.target),
      words(camera.up), camera.fov_y_degrees, context.seed);
}

std::vector<std::byte> to_bytes(const Artefact& artefact) {
  std::vector<std::byte> out;
  const FinalGather& f = artefact.final_gather;
  append(out, std::vector<uint32_t>{f.diffuse.columns});
  append(out, artefact.cloud.samples);
  append(out, artefact.cloud.area);
  append(out, f.diffuse.row_start);
  append(out, f.diffuse.entries);
  append(out, f.glossy_pixels);
  append(out, f.glossy.row_start);
  append(out, f.glossy.entries);
  const MultiBounce& m = artefact.multi_bounce;
  append(out, std::vector<int32_t>{m.bounces});
  append(out, std::vector<double>{m.share_beyond});
  append(out, m.photons.row_start);
  append(out, m.photons.entries);
  append(out, m.transfer.row_start);
  append(out, m.transfer.entries);
  return out;
}

Artefact from_bytes(const std::vector<std::byte>& bytes) {
  Reader reader(bytes);
  Artefact artefact;
  const std::vector<uint32_t> columns = reader.next<uint32_t>();
  artefact.cloud.samples = reader.next<SurfaceSample>();
  artefact.cloud.area = reader.next<float>();
  FinalGather& f = artefact.final_gather;
  f.diffuse.row_start = reader.next<uint64_t>();
  f.diffuse.entries = reader.next<SparseEntry>();
  f.glossy_pixels = reader.next<uint32_t>();
  f.glossy.row_start = reader.next<uint64_t>();
  f.glossy.entries = reader.next<SparseEntry>();
  const std::vector<int32_t> bounces = reader.next<int32_t>();
  const std::vector<double> share_beyond = reader.next<double>();
  MultiBounce& m = artefact.multi_bounce;
  m.photons.row_start = reader.next<uint64_t>();
  m.photons.entries = reader.next<SparseEntryRgb>();
  m.transfer.row_start = reader.next<uint64_t>();
  m.transfer.entries = reader.next<SparseEntry>();
  if (columns.size() != 1 || columns[0] != artefact.cloud.samples.size() || bounces.size() != 1 ||
      share_beyond.size() != 1 || f.glossy_pixels.size() != f.glossy.rows())
    fail("cached artefact: inconsistent sizes");
  f.diffuse.columns = f.glossy.columns = m.photons.columns = m.transfer.columns = columns[0];
  m.bounces = bounces[0];
  m.share_beyond = share_beyond[0];
  return artefact;
}

}  // namespace relight::direct_to_indirect
