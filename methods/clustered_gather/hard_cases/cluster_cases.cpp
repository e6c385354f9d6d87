// Points that break clustering: equal ones, normals that cancel, more clusters than points.
#include <algorithm>
#include <cmath>

#include "common/hard_cases/image_difference.h"
#include "common/hard_cases/method_bench.h"
#include "common/hard_cases/tiny_scenes.h"
#include "methods/clustered_gather/clustered_gather.h"
#include "methods/clustered_gather/clustering.h"
#include "methods/clustered_gather/gather_samples.h"
#include "methods/clustered_gather/hard_cases/hard_cases.h"
#include "methods/clustered_gather/representative.h"

namespace relight::clustered_gather {

namespace {

using namespace hard;

// Two thousand points at one place with one normal, clustered to 120.
Figures all_points_equal() {
  SurfaceSample sample;
  sample.position = {0.3f, -0.2f, 0.7f};
  sample.shading_normal = sample.geometric_normal = {0, 0, 1};
  sample.valid = true;
  const std::vector<SurfaceSample> samples(2000, sample);
  const Metric6 metric(3.5f, 1.0f);
  const std::vector<Point6> points(2000, metric(sample.position, sample.shading_normal));
  Figures figures;
  for (const auto start : {ClusteringStart::hierarchical, ClusteringStart::random}) {
    ClusteringSettings settings;
    settings.clusters = 120;
    settings.start = start;
    const Clustering c = cluster_points(points, settings);
    const SurfaceSample mean = representative(samples, members_of(c.cluster_of, c.centres.size()).of(0));
    add_worst(figures, at_most("clusters", static_cast<double>(c.centres.size()), 1.0,
                               "equal points are not told apart, and no cluster is empty"));
    add_worst(figures, at_most("total distance", total_distance(points, c), 1e-9,
                               "every point is its cluster's centre; rounding of a mean of 2,000"));
    add_worst(figures, at_most("distance of what stands for them",
                               static_cast<double>(glm::distance(mean.position, sample.position) +
                                                   glm::distance(mean.shading_normal, sample.shading_normal)),
                               1e-6, "it is one of them; rounding of the mean normal"));
  }
  return figures;
}

// A canyon: what its floor sees is two walls that face each other, in equal shares.
Scene canyon() {
  Scene scene = tiny::empty_scene(glm::vec3(0.6f));
  tiny::add_quad(scene, {-0.05f, 0, -10}, {0, 0, 20}, {0.1f, 0, 0});
  tiny::add_quad(scene, {-0.05f, 0, -10}, {0, 2, 0}, {0, 0, 20});
  tiny::add_quad(scene, {0.05f, 0, -10}, {0, 0, 20}, {0, 2, 0});
  scene.camera.eye = {0.003f, 3.0f, 0.1f};
  scene.camera.target = {0.002f, 0.0f, 0.0f};
  scene.camera.fov_y_degrees = 1.5f;
  finish_scene(scene);
  return scene;
}

struct CanyonGather {
  Scene scene = canyon();
  RayTracer tracer{scene};
  Metric6 metric{scene.bounds.diagonal(), 1.0f};
  ViewClusters view;

  CanyonGather() {
    const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 16, 12});
    ClusteringSettings settings;
    settings.clusters = 20;
    view = cluster_view(buffer, pixels_with(buffer, Part::diffuse), metric, settings);
  }
  GatherSamples gather(size_t clusters) const {
    GatherSettings settings;
    settings.directions = 400;
    settings.clusters = clusters;
    Progress quiet(true);
    StageLog log;
    GatherSamples out;
    add_gather_samples(tracer, view, metric, settings, quiet, log, out);
    return out;
  }
};

double sum_of_albedos(const GatherSamples& g, size_t k) {
  double sum = 0.0;
  for (uint32_t i = g.first[k]; i < g.first[k + 1]; ++i) sum += static_cast<double>(g.samples[i].diffuse.x);
  return sum;
}

Figures opposing_normals() {
  const CanyonGather canyon;
  const GatherSamples all = canyon.gather(0), one = canyon.gather(1);
  double length = 0.0, side = 1.0, energy = 0.0, cancelled = 0.0;
  for (const SurfaceSample& s : one.samples) {
    length = std::max(length, std::abs(static_cast<double>(glm::length(s.shading_normal)) - 1.0));
    side = std::min(side, static_cast<double>(glm::dot(s.shading_normal, s.geometric_normal)));
  }
  for (size_t k = 0; k + 1 < all.first.size(); ++k) {
    energy = std::max(energy, std::abs(sum_of_albedos(all, k) - sum_of_albedos(one, k)));
    glm::dvec3 mean(0.0);
    for (uint32_t i = all.first[k]; i < all.first[k + 1]; ++i)
      mean += glm::dvec3(all.samples[i].shading_normal);
    cancelled += glm::length(mean) < 0.2 * (all.first[k + 1] - all.first[k]);
  }
  return {
      at_most("length of a normal off 1", length, 1e-5, "a mean of zero has no direction to be scaled to"),
      at_least("cosine between mean and own normal", side, 0.0,
               "a sample must not shine on what its place cannot see"),
      at_most("change of a cluster's weight times albedo", energy, 1e-6, "clustering keeps the sum"),
      at_least("view clusters whose gather normals cancel to a fifth", cancelled, 5.0,
               "else the case is none")};
}

// Every ray, and every pixel, a cluster of its own: asked for by 0, and by more than there are.
Figures more_clusters_than_samples() {
  MethodBench bench(make_clustered_gather(), tiny::room(), {{"device", "cpu"}, {"directions", "64"}}, 24, 18);
  const LightingState lighting = tiny::lighting({tiny::omni({0.2f, 0.4f, 0.7f})});
  const Relit all = bench.relight({{"view_clusters", "0"}, {"gather_clusters", "0"}}, lighting);
  const Relit more = bench.relight({{"view_clusters", "16777216"}, {"gather_clusters", "1048576"}}, lighting);
  return {non_finite_pixels({&all.total, &more.total}),
          at_most("relative difference of indirect light", relative_difference(more.indirect, all.indirect),
                  0.0, "each sample is its own cluster either way"),
          at_least("indirect light", norm(all.indirect), 1e-9, "else there is nothing to compare")};
}

}  // namespace

Cases cluster_cases() {
  return {{"all gather points equal", "A split of equal points never ends; empty clusters divide by zero.",
           all_points_equal},
          {"clusters of opposing normals", "A mean normal of zero has no direction.", opposing_normals},
          {"more clusters than samples", "Clusters without members.", more_clusters_than_samples}};
}

}  // namespace relight::clustered_gather
