#include "methods/clustered_gather/artefact.h"

#include <cstring>
#include <type_traits>

#include <fmt/format.h>

#include "common/run/error.h"

namespace relight::clustered_gather {
namespace {

constexpr int precompute_version = 2;

struct StoredSample {
  glm::vec3 position, shading_normal, geometric_normal, diffuse;
};

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

std::string words(const glm::vec3& v) { return fmt::format("({},{},{})", v.x, v.y, v.z); }

}  // namespace

std::string cache_key(const PrepareContext& context) {
  const View& view = context.buffer.view;
  const Camera& camera = view.camera;
  return fmt::format("version={};layout={};scene={:016x};view={}x{};eye={};target={};up={};fov={};seed={};{}",
                     precompute_version, sizeof(StoredSample), context.scene.content_hash, view.width,
                     view.height, words(camera.eye), words(camera.target), words(camera.up),
                     camera.fov_y_degrees, context.seed, context.knobs.precompute_key());
}

std::vector<std::byte> to_bytes(const Artefact& artefact) {
  std::vector<StoredSample> samples;
  samples.reserve(artefact.gather.samples.size());
  for (const SurfaceSample& s : artefact.gather.samples)
    samples.push_back({s.position, s.shading_normal, s.geometric_normal, s.diffuse});
  std::vector<std::byte> out;
  append(out, samples);
  append(out, artefact.gather.first);
  for (const Links* links : {&artefact.diffuse, &artefact.glossy}) {
    append(out, std::vector<uint32_t>{links->per_pixel});
    append(out, links->pixel);
    append(out, links->cluster);
    append(out, links->weight);
  }
  return out;
}

Artefact from_bytes(const std::vector<std::byte>& bytes) {
  Reader reader(bytes);
  Artefact artefact;
  for (const StoredSample& stored : reader.next<StoredSample>()) {
    SurfaceSample s;
    s.position = stored.position, s.diffuse = stored.diffuse;
    s.shading_normal = stored.shading_normal, s.geometric_normal = stored.geometric_normal;
    s.valid = true;
    artefact.gather.samples.push_back(s);
  }
  artefact.gather.first = reader.next<uint32_t>();
  for (Links* links : {&artefact.diffuse, &artefact.glossy}) {
    const std::vector<uint32_t> per_pixel = reader.next<uint32_t>();
    links->pixel = reader.next<uint32_t>();
    links->cluster = reader.next<uint32_t>();
    links->weight = reader.next<float>();
    if (per_pixel.size() != 1 || links->cluster.size() != links->weight.size() ||
        links->cluster.size() != links->pixel.size() * per_pixel[0])
      fail("cached artefact: inconsistent sizes");
    links->per_pixel = per_pixel[0];
  }
  if (artefact.gather.first.empty() || artefact.gather.first.back() != artefact.gather.samples.size())
    fail("cached artefact: inconsistent sizes");
  return artefact;
}

}  // namespace relight::clustered_gather
