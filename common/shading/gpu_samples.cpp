#include "common/shading/direct_lighting.h"

namespace relight {
namespace {

// 64 bytes, read by direct_lighting.glsl.
struct PackedSample {
  glm::vec4 position_exponent, ns_ngx, ngyz_diffuse_rg, diffuse_b_glossy;
};

PackedSample pack(const SurfaceSample& s) {
  if (!s.valid) return {glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(0.0f)};
  return {glm::vec4(s.position, s.exponent), glm::vec4(s.shading_normal, s.geometric_normal.x),
          glm::vec4(s.geometric_normal.y, s.geometric_normal.z, s.diffuse.r, s.diffuse.g),
          glm::vec4(s.diffuse.b, s.glossy)};
}

}  // namespace

GpuSamples::GpuSamples(const std::vector<SurfaceSample>& samples, const glm::vec3& eye)
    : samples_(samples), eye_(eye), data_(static_cast<int64_t>(samples.size() * sizeof(PackedSample))) {
  // Packed piece by piece: a whole view would need another 80 MB for a moment.
  constexpr size_t piece = 1 << 16;
  std::vector<PackedSample> packed;
  for (size_t begin = 0; begin < samples.size(); begin += piece) {
    const size_t end = std::min(samples.size(), begin + piece);
    packed.clear();
    for (size_t i = begin; i < end; ++i) packed.push_back(pack(samples[i]));
    data_.upload(static_cast<int64_t>(begin * sizeof(PackedSample)),
                 static_cast<int64_t>(packed.size() * sizeof(PackedSample)), packed.data());
  }
}

int64_t GpuSamples::bytes() const { return data_.bytes(); }

void GpuSamples::bind(int first_binding) const { data_.bind_storage(first_binding); }

void GpuSamples::bind_range(int binding, int64_t first, int64_t count) const {
  constexpr auto size = static_cast<int64_t>(sizeof(PackedSample));
  data_.bind_storage(binding, first * size, count * size);
}

}  // namespace relight
