#include "methods/direct_to_indirect/light_points.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace relight::direct_to_indirect {
namespace {

constexpr size_t four = light_points_a_sample;

// Of the points [first, first + 4).
size_t closest_to_mean(const std::vector<SurfaceSample>& points, size_t first) {
  glm::dvec3 mean(0.0);
  for (size_t k = first; k < first + four; ++k) mean += glm::dvec3(points[k].position) / double{four};
  size_t best = first;
  double least = INFINITY;
  for (size_t k = first; k < first + four; ++k) {
    const glm::dvec3 d = glm::dvec3(points[k].position) - mean;
    if (glm::dot(d, d) < least) least = glm::dot(d, d), best = k;
  }
  return best;
}

}  // namespace

GatherCloud gather_samples_of(GatherCloud& points) {
  GatherCloud out;
  for (size_t first = 0; first < points.samples.size(); first += four) {
    out.samples.push_back(points.samples[closest_to_mean(points.samples, first)]);
    float area = 0.0f;
    for (size_t k = first; k < first + four; ++k) area += points.area[k];
    out.area.push_back(area);
    for (size_t k = first; k < first + four; ++k)
      points.samples[k].diffuse *= area > 0.0f ? float{four} * points.area[k] / area : 1.0f;
  }
  return out;
}

void mean_of_points(std::span<const glm::vec4> points, std::span<glm::vec4> out) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, out.size(), 4096), [&](const auto& range) {
    for (size_t j = range.begin(); j < range.end(); ++j) {
      const glm::vec4* p = points.data() + four * j;
      out[j] = 0.25f * ((p[0] + p[1]) + (p[2] + p[3]));
    }
  });
}

MeanOfPointsGpu::MeanOfPointsGpu(size_t gather_samples)
    : program_(gpu::Program::compute("methods/direct_to_indirect/light_points.glsl")),
      means_(static_cast<int64_t>(gather_samples * sizeof(glm::vec4))) {}

const gpu::Buffer& MeanOfPointsGpu::mean(const gpu::Buffer& points) const {
  const int64_t count = means_.bytes() / static_cast<int64_t>(sizeof(glm::vec4));
  program_.use();
  points.bind_storage(0);
  means_.bind_storage(1);
  program_.set("count", static_cast<uint32_t>(count));
  program_.dispatch_items(count, 64);
  return means_;
}

}  // namespace relight::direct_to_indirect
