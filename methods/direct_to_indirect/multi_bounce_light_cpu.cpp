#include "methods/direct_to_indirect/multi_bounce_light_cpu.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace relight::direct_to_indirect {
namespace {

constexpr size_t rows_a_task = 256;

std::vector<glm::vec3> albedos(const GatherCloud& cloud) {
  std::vector<glm::vec3> out;
  for (const SurfaceSample& s : cloud.samples) out.push_back(s.diffuse);
  return out;
}

}  // namespace

MultiBounceLightCpu::MultiBounceLightCpu(MultiBounce data, const GatherCloud& cloud)
    : photons_(std::move(data.photons)),
      passes_(photons_.rows() > 0 ? 1 : data.bounces - 1),
      haar_(cloud.samples.size()),
      coefficients_(cloud.samples.size()),
      light_(cloud.samples.size()) {
  if (photons_.rows() == 0) transfer_.emplace(data.transfer, albedos(cloud), WeightFormat::float32);
}

// Horner's rule, as in multi_bounce_light.h.
std::span<const glm::vec4> MultiBounceLightCpu::with_bounces(std::span<const glm::vec4> direct) {
  std::span<const glm::vec4> light = direct;
  for (int pass = 0; pass < passes_; ++pass) {
    haar_.forward(light, coefficients_);
    if (transfer_)
      transfer_->multiply(coefficients_, light_);
    else
      multiply_photons();
    for (size_t i = 0; i < light_.size(); ++i) light_[i] += direct[i];
    light = light_;
  }
  return light;
}

void MultiBounceLightCpu::multiply_photons() {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, photons_.rows(), rows_a_task), [&](const auto& range) {
    for (size_t row = range.begin(); row < range.end(); ++row) {
      glm::vec4 sum(0.0f);
      for (uint64_t e = photons_.row_start[row]; e < photons_.row_start[row + 1]; ++e)
        sum += glm::vec4(photons_.entries[e].value, 0.0f) * coefficients_[photons_.entries[e].column];
      light_[row] = sum;
    }
  });
}

int64_t MultiBounceLightCpu::matrix_bytes() const {
  return photons_.bytes() + (transfer_ ? transfer_->bytes() : 0);
}

}  // namespace relight::direct_to_indirect
