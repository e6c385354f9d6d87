// Importance sampling of an environment map: a direction is drawn from a density that is constant on each
// texel and proportional to what the bilinear lookup gives there, times the texel's solid angle.
#pragma once

#include <vector>

#include "common/scene/scene.h"

namespace relight {

struct EnvironmentSample {
  glm::vec3 direction{0.0f, 1.0f, 0.0f};
  float pdf = 0.0f;  // [1/sr]; 0: there is nothing to sample
};

class EnvironmentSampler {
 public:
  // Empty for an environment that is black or of constant radiance: BRDF samples do as well there.
  explicit EnvironmentSampler(const Environment& environment);

  bool empty() const { return rows_.empty(); }
  const Environment& environment() const { return environment_; }
  // u in [0,1)^2.
  EnvironmentSample sample(const glm::vec2& u) const;
  // Density of sample() at a unit direction.
  float pdf(const glm::vec3& direction) const;

 private:
  const Environment& environment_;
  int width_ = 0, height_ = 0;
  std::vector<double> rows_;     // cumulative probability of rows, height
  std::vector<double> columns_;  // cumulative probability within each row, height x width
  double probability(int column, int row) const;
  float texel_pdf(int column, int row) const;
};

}  // namespace relight
