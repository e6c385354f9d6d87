#include "methods/clustered_gather/sums_cpu.h"

#include <tbb/parallel_for.h>

namespace relight::clustered_gather {

namespace {

template <typename Real>
glm::vec<3, Real> linked(const Links& links, size_t i, const std::vector<glm::vec<3, Real>>& gathered) {
  const size_t n = links.per_pixel;
  glm::vec<3, Real> sum(Real(0));
  for (size_t k = i * n; k < (i + 1) * n; ++k)
    sum += static_cast<Real>(links.weight[k]) * gathered[links.cluster[k]];
  return sum;
}

}  // namespace

SumsCpu::SumsCpu(Artefact artefact, const DeepFrameBuffer& buffer)
    : first_(std::move(artefact.gather.first)),
      diffuse_(std::move(artefact.diffuse)),
      glossy_(std::move(artefact.glossy)) {
  for (const SurfaceSample& s : buffer.indirect) albedo_.push_back(s.diffuse);
}

template <typename Real>
std::vector<glm::vec<3, Real>> SumsCpu::gathered(std::span<const glm::vec4> radiance) const {
  std::vector<glm::vec<3, Real>> out(first_.empty() ? 0 : first_.size() - 1);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, out.size(), 64), [&](const auto& range) {
    for (size_t k = range.begin(); k < range.end(); ++k) {
      glm::vec<4, Real> sum(Real(0));
      for (uint32_t i = first_[k]; i < first_[k + 1]; ++i) sum += glm::vec<4, Real>(radiance[i]);
      out[k] = glm::vec<3, Real>(sum);
    }
  });
  return out;
}

template <typename Real>
std::vector<glm::vec4> SumsCpu::interpolate(const std::vector<glm::vec<3, Real>>& gathered) const {
  std::vector<glm::vec4> out(albedo_.size(), glm::vec4(0.0f));
  const auto each = [](const Links& links, auto body) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, links.pixel.size(), 1024), [&](const auto& range) {
      for (size_t i = range.begin(); i < range.end(); ++i) body(i, links.pixel[i]);
    });
  };
  each(diffuse_, [&](size_t i, uint32_t p) {
    out[p] = glm::vec4(glm::vec3(linked(diffuse_, i, gathered) * glm::vec<3, Real>(albedo_[p])), 0.0f);
  });
  each(glossy_,
       [&](size_t i, uint32_t p) { out[p] += glm::vec4(glm::vec3(linked(glossy_, i, gathered)), 0.0f); });
  return out;
}

int64_t SumsCpu::bytes() const {
  int64_t bytes = static_cast<int64_t>(first_.size() * sizeof(uint32_t) + albedo_.size() * sizeof(glm::vec3));
  for (const Links* links : {&diffuse_, &glossy_})
    bytes += static_cast<int64_t>(links->pixel.size() * sizeof(uint32_t) +
                                  links->cluster.size() * (sizeof(uint32_t) + sizeof(float)));
  return bytes;
}

template std::vector<glm::vec<3, float>> SumsCpu::gathered<float>(std::span<const glm::vec4>) const;
template std::vector<glm::vec<3, double>> SumsCpu::gathered<double>(std::span<const glm::vec4>) const;
template std::vector<glm::vec4> SumsCpu::interpolate<float>(const std::vector<glm::vec<3, float>>&) const;
template std::vector<glm::vec4> SumsCpu::interpolate<double>(const std::vector<glm::vec<3, double>>&) const;

}  // namespace relight::clustered_gather
