#include "methods/direct_to_indirect/multi_bounce_light.h"

#include "common/wavelet/haar.h"

namespace relight::direct_to_indirect {

MultiBounceLight::MultiBounceLight(MultiBounce data, const GatherCloud& cloud, int64_t max_block_bytes)
    : data_(std::move(data)), light_(static_cast<int64_t>(cloud.samples.size()) * 16) {
  for (const SurfaceSample& s : cloud.samples) albedo_.push_back(s.diffuse);
  if (by_photons())
    photons_.emplace(data_.photons, max_block_bytes);
  else
    transfer_.emplace(data_.transfer, albedo_, max_block_bytes);
}

const gpu::Buffer& MultiBounceLight::with_bounces(const gpu::Buffer& direct,
                                                  const wavelet::HaarGpu& haar) const {
  const gpu::Buffer* light = &direct;
  for (int pass = 0; pass < passes(); ++pass) {
    haar.forward(*light);
    if (by_photons())
      photons_->multiply(haar.coefficients(), light_);
    else
      transfer_->multiply(haar.coefficients(), light_);
    sum_.add(direct, light_);
    light = &light_;
  }
  return *light;
}

std::vector<glm::dvec3> MultiBounceLight::with_bounces(const std::vector<glm::dvec3>& direct) const {
  std::vector<glm::dvec3> light = direct;
  for (int pass = 0; pass < passes(); ++pass) {
    const std::vector<glm::dvec3> coefficients = wavelet::forward(light);
    if (by_photons()) {
      light = multiply(data_.photons, coefficients);
    } else {
      const std::vector<glm::vec3> arriving = multiply(data_.transfer, coefficients);
      for (size_t i = 0; i < light.size(); ++i) light[i] = glm::dvec3(albedo_[i]) * glm::dvec3(arriving[i]);
    }
    for (size_t i = 0; i < light.size(); ++i) light[i] += direct[i];
  }
  return light;
}

int64_t MultiBounceLight::gpu_bytes() const { return photons_ ? photons_->bytes() : transfer_->bytes(); }

}  // namespace relight::direct_to_indirect
