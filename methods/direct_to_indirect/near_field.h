// Elements of the final gather between points that are close to each other. Not in the paper, which clamps
// them (section 4.3) and names the darkening in corners that follows.
//
// A gather sample is near a view sample where its cell, taken as a disc that faces it, would fill more than a
// share `threshold` of the view sample's hemisphere: A_j > threshold x pi r^2. There a point no longer stands
// for its cell. Two ways to do better:
//   cell_average  the mean over several points of the cell, each with its own ray, 1/r^2 bounded as a disc's;
//   hemisphere    cosine-distributed rays from the view sample, each snapped to the gather sample in whose
//                 cell it ends: no 1/r^2 at all.
// Everything that is not near stays with the links.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/sampling/gather_cloud.h"
#include "common/tracing/ray_tracer.h"
#include "methods/direct_to_indirect/hierarchy.h"

namespace relight::direct_to_indirect {

// A near gather sample and the element F_ij of the final-gather matrix; 0 if nothing of it is seen.
struct NearElement {
  uint32_t sample;
  float value;
};

struct NearFieldSettings {
  float threshold = 0.01f;  // share of the hemisphere from which on a gather sample is near
  int rays = 256;           // a view sample that has anything near (hemisphere)
  uint64_t seed = 1;
};

class NearField {
 public:
  // cell_points: points spread like the gather cloud, several for each of its samples, which the cells'
  // averages are taken over; none: hemisphere rays. All other arguments must outlive this.
  NearField(const RayTracer& tracer, const GatherCloud& cloud, const GatherHierarchy& hierarchy,
            const NearFieldSettings& settings, const std::vector<SurfaceSample>& cell_points = {});
  ~NearField();

  // All gather samples near `view`, ascending, with their elements; rays are added to `rays`. `number`
  // selects the random numbers. Thread-safe.
  void elements(const SurfaceSample& view, uint64_t number, std::vector<NearElement>& out,
                int64_t& rays) const;

 private:
  void collect(const SurfaceSample& view, size_t level, size_t index, std::vector<NearElement>& out) const;
  void shoot(const SurfaceSample& view, uint64_t number, std::vector<NearElement>& near, int64_t& rays) const;
  void average_cells(const SurfaceSample& view, std::vector<NearElement>& near, int64_t& rays) const;

  struct Cells;
  const RayTracer& tracer_;
  const GatherCloud& cloud_;
  const GatherHierarchy& tree_;
  NearFieldSettings settings_;
  std::vector<std::vector<float>> largest_area_;  // of a cluster's members; like tree_.levels
  std::unique_ptr<Cells> cells_;
};

// Distance r at which A / (pi r^2) = threshold, for a cell of area A.
float near_distance(float area, float threshold);

}  // namespace relight::direct_to_indirect
