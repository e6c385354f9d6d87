#include "methods/clustered_gather/sums_cpu.h"

#include <tbb/parallel_for.h>

namespace relight::clustered_gather {

SumsCpu::SumsCpu(std::vector<uint32_t> first, Links links, const DeepFrameBuffer& buffer)
    : first_(std::move(first)), links_(std::move(links)) {
  for (const SurfaceSample& s : buffer.indirect) albedo_.push_back(s.diffuse);
}

template <typename Real>
std::vector<glm::vec<3, Real>> SumsCpu::irradiance(std::span<const glm::vec4> radiance) const {
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
std::vector<glm::vec4> SumsCpu::interpolate(const std::vector<glm::vec<3, Real>>& irradiance) const {
  std::vector<glm::vec4> out(albedo_.size(), glm::vec4(0.0f));
  const size_t n = links_.per_pixel;
  if (n == 0) return out;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, out.size(), 1024), [&](const auto& range) {
    for (size_t p = range.begin(); p < range.end(); ++p) {
      glm::vec<3, Real> sum(Real(0));
      for (size_t k = p * n; k < (p + 1) * n; ++k)
        sum += static_cast<Real>(links_.weight[k]) * irradiance[links_.cluster[k]];
      out[p] = glm::vec4(glm::vec3(sum * glm::vec<3, Real>(albedo_[p])), 0.0f);
    }
  });
  return out;
}

int64_t SumsCpu::bytes() const {
  return static_cast<int64_t>(first_.size() * sizeof(uint32_t) +
                              links_.cluster.size() * (sizeof(uint32_t) + sizeof(float)) +
                              albedo_.size() * sizeof(glm::vec3));
}

template std::vector<glm::vec<3, float>> SumsCpu::irradiance<float>(std::span<const glm::vec4>) const;
template std::vector<glm::vec<3, double>> SumsCpu::irradiance<double>(std::span<const glm::vec4>) const;
template std::vector<glm::vec4> SumsCpu::interpolate<float>(const std::vector<glm::vec<3, float>>&) const;
template std::vector<glm::vec4> SumsCpu::interpolate<double>(const std::vector<glm::vec<3, double>>&) const;

}  // namespace relight::clustered_gather
