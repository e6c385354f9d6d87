// Gather samples of each view cluster: points that its hemisphere sees, found by quasi-Monte Carlo rays and
// reduced to a few clusters at once, so that the full set is never in memory (clustered gather paper, 2006,
// sections 3.1 to 3.3, equations 2 and 3).
//
// Diffuse: directions follow the cosine to the view cluster's normal, so that each weighs 1 / directions and
// the sum of weight x radiance leaving the points is irradiance / pi. Glossy: they follow the lobe of the
// cluster's BRDF towards the eye and weigh f cos / (density x directions), so that the sum is the radiance
// reflected to the eye. Directions that start below a surface count as black; those that hit nothing do too,
// or become environment samples if there is light from there (environment_shares.h), which take a share of
// the clusters in proportion to their weight.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/linalg/sparse_rows_rgb.h"
#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "common/tracing/ray_tracer.h"
#include "methods/clustered_gather/clustering.h"
#include "methods/clustered_gather/view_clusters.h"

namespace relight::clustered_gather {

// What is left of a sample once it is Lambertian: all that is lit, and kept in the artefact cache. 48 bytes
// where a SurfaceSample has 128.
struct LambertSample {
  glm::vec3 position, shading_normal, geometric_normal, diffuse;
};
LambertSample lambert_part(const SurfaceSample& sample);
SurfaceSample surface_sample(const LambertSample& sample);

// Samples first[k] .. first[k + 1] - 1 belong to view cluster k. Their diffuse albedo is multiplied by their
// weight, as in the paper: the sum of the radiance that leaves them is what the view cluster gathers.
struct GatherSamples {
  std::vector<SurfaceSample> samples;
  std::vector<uint32_t> first{0};  // view clusters + 1
  SparseRowsRgb environment;       // one row a view cluster (environment_shares.h); nothing if not asked for
};

struct GatherSettings {
  int directions = 2000;
  size_t clusters = 120;  // gather samples kept of each; 0: all
  ClusteringStart start = ClusteringStart::hierarchical;
  int iterations = 5;
  uint64_t seed = 1;
  Part part = Part::diffuse;
  glm::vec3 eye{0.0f};  // where glossy light is seen from
  int64_t environment_samples =
      0;  // texels of the environment square; 0: directions that hit nothing are black
  std::span<const uint8_t>
      used{};  // by view cluster: 0 = nobody asks for its gather samples; none: all are used
};

// Logs counters gather_rays, gather_points (rays that hit) and gather_samples; of the glossy part with the
// prefix glossy_; with environment_samples, of both parts together, environment_misses and
// environment_samples. Appends to `out`; its view clusters are numbered after those that are there. Parallel,
// deterministic.
void add_gather_samples(const RayTracer& tracer, const ViewClusters& view, const Metric6& metric,
                        const GatherSettings& settings, Progress& progress, StageLog& log,
                        GatherSamples& out);

}  // namespace relight::clustered_gather
