// Final-gather rows pair by pair in double precision: what hard cases and tests compare the tree with.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/hard_cases/gather_setup.h"

namespace relight::direct_to_indirect {

// F_ij of final_gather.h, pair by pair, in double, without tree, tile or packet.
inline std::vector<double> oracle_row(const GatherSetup& s, const SurfaceSample& v, double clamp) {
  std::vector<double> row(s.cloud.samples.size(), 0.0);
  for (size_t j = 0; j < row.size(); ++j) {
    const SurfaceSample& g = s.cloud.samples[j];
    const glm::dvec3 w = glm::dvec3(g.position) - glm::dvec3(v.position);
    const double r2 = glm::dot(w, w);
    const double cv = glm::dot(glm::dvec3(v.shading_normal), w),
                 cg = -glm::dot(glm::dvec3(g.geometric_normal), w);
    if (!(r2 > 0.0) || cv <= 0.0 || cg <= 0.0 || glm::dot(glm::dvec3(v.geometric_normal), w) <= 0.0) continue;
    if (!s.tracer.visible(v.position, v.geometric_normal, g.position, g.geometric_normal)) continue;
    row[j] = std::min(clamp, cv * cg * static_cast<double>(s.cloud.area[j]) / (std::numbers::pi * r2 * r2));
  }
  return row;
}

// Largest difference over every fifth row, relative to the largest element of the oracle's row.
inline double worst_difference(GatherSetup& s, const FinalGatherSettings& settings, double clamp) {
  const SparseRows rows = s.final_gather(settings);
  double worst = 0.0;
  for (size_t i = 0; i < s.buffer.indirect.size(); i += 5) {
    if (!s.buffer.indirect[i].valid) continue;
    const std::vector<double> expected = oracle_row(s, s.buffer.indirect[i], clamp);
    const std::vector<double> got = wavelet::inverse(dense_row(rows, i));
    const double largest = *std::max_element(expected.begin(), expected.end());
    const double scale = largest > 0.0 ? largest : 1.0;
    for (size_t j = 0; j < got.size(); ++j) {
      const double difference = std::abs(got[j] - expected[j]) / scale;
      worst = std::isfinite(difference) ? std::max(worst, difference) : INFINITY;
    }
  }
  return worst;
}

}  // namespace relight::direct_to_indirect
