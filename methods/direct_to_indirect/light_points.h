// Several points of each gather sample on which direct light is computed and averaged, so that a light's rim
// that crosses the sample's cell lights part of it. Not in the paper, which computes direct light on the
// gather samples themselves (light_points=1). The matrices keep one column a gather sample.
//
// The points are a gather cloud of four times as many samples in tree order: the four of a gather sample are
// the children of one cluster.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/sampling/gather_cloud.h"

namespace relight::direct_to_indirect {

constexpr size_t light_points_a_sample = 4;

// Gather samples of a cloud of points in tree order: for each four the one closest to their mean position,
// with the area of all four. Scales the points' albedos so that the mean of the light of four points is that
// of their cell, weighted by area. Both stay in tree order.
GatherCloud gather_samples_of(GatherCloud& points);

// out[j] = mean of points[4j .. 4j+3]. Parallel.
void mean_of_points(std::span<const glm::vec4> points, std::span<glm::vec4> out);

class MeanOfPointsGpu {
 public:
  // Needs a current context.
  explicit MeanOfPointsGpu(size_t gather_samples);
  // points: four vec4 a gather sample. The result is valid until the next call.
  const gpu::Buffer& mean(const gpu::Buffer& points) const;
  int64_t bytes() const { return means_.bytes(); }

 private:
  gpu::Program program_;
  gpu::Buffer means_;
};

}  // namespace relight::direct_to_indirect
