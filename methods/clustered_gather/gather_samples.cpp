#include "methods/clustered_gather/gather_samples.h"

#include <cmath>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "common/brdf/brdf.h"
#include "common/run/error.h"
#include "common/sampling/random.h"
#include "methods/clustered_gather/representative.h"

namespace relight::clustered_gather {
namespace {

constexpr uint64_t stream = 0x67617468657231ull;

struct Worker {
  std::vector<SurfaceSample> points;
  std::vector<Point6> points6;
  int64_t rays = 0, hits = 0;
};

// The diffuse points that directions from the view cluster hit. Points that reflect nothing diffusely are
// kept: they are part of what the clusters must cover, and removing them would be a clustering of its own.
void trace(const RayTracer& tracer, const SurfaceSample& from, uint64_t scramble, int directions,
           Worker& worker) {
  worker.points.clear();
  const glm::vec3 origin = tracer.offset_point(from.position, from.geometric_normal);
  for (int i = 0; i < directions; ++i) {
    const glm::vec3 w = sample_cosine(from.shading_normal, sobol_2d(static_cast<uint32_t>(i), scramble));
    if (!(glm::dot(w, from.geometric_normal) > 0.0f)) continue;
    ++worker.rays;
    const Hit hit = tracer.intersect(origin, w);
    if (hit.valid) worker.points.push_back(tracer.surface(hit, w));
  }
  worker.hits += static_cast<int64_t>(worker.points.size());
}

// One gather sample for each cluster of the points, diffuse albedo = sum of weight x albedo of the members.
std::vector<SurfaceSample> reduce(Worker& worker, const Metric6& metric, const GatherSettings& settings,
                                  uint64_t seed) {
  const float weight = 1.0f / static_cast<float>(settings.directions);
  const size_t limit = settings.clusters == 0 ? worker.points.size() : settings.clusters;
  if (worker.points.size() <= limit) {
    std::vector<SurfaceSample> all = worker.points;
    for (SurfaceSample& s : all) s.diffuse *= weight;
    return all;
  }
  worker.points6.clear();
  for (const SurfaceSample& s : worker.points) worker.points6.push_back(metric(s.position, s.shading_normal));
  ClusteringSettings clustering_settings;
  clustering_settings.clusters = limit;
  clustering_settings.start = settings.start;
  clustering_settings.iterations = settings.iterations;
  clustering_settings.seed = seed;
  const Clustering clustering = cluster_points(worker.points6, clustering_settings);
  const Members members = members_of(clustering.cluster_of, clustering.centres.size());
  std::vector<SurfaceSample> reduced;
  for (size_t k = 0; k < clustering.centres.size(); ++k) {
    reduced.push_back(representative(worker.points, members.of(k)));
    glm::dvec3 albedo(0.0);
    for (const uint32_t i : members.of(k)) albedo += glm::dvec3(worker.points[i].diffuse);
    reduced.back().diffuse = glm::vec3(albedo * static_cast<double>(weight));
  }
  return reduced;
}

}  // namespace

GatherSamples make_gather_samples(const RayTracer& tracer, const ViewClusters& view, const Metric6& metric,
                                  const GatherSettings& settings, Progress& progress, StageLog& log) {
  std::vector<std::vector<SurfaceSample>> reduced(view.samples.size());
  tbb::enumerable_thread_specific<Worker> workers;
  progress.start("gather samples", static_cast<int>(view.samples.size()));
  tbb::parallel_for(size_t{0}, view.samples.size(), [&](size_t k) {
    Worker& worker = workers.local();
    const uint64_t scramble = random_bits(settings.seed, stream, k, 0);
    trace(tracer, view.samples[k], scramble, settings.directions, worker);
    reduced[k] = reduce(worker, metric, settings, scramble);
    progress.advance();
  });
  progress.finish();
  GatherSamples out;
  size_t total = 0;
  for (const auto& r : reduced) total += r.size();
  if (total >= (size_t{1} << 32)) fail("clustered_gather: {} gather samples; at most 2^32 - 1", total);
  out.samples.reserve(total);
  out.first.push_back(0);
  for (auto& r : reduced) {
    out.samples.insert(out.samples.end(), r.begin(), r.end());
    out.first.push_back(static_cast<uint32_t>(out.samples.size()));
    r = {};
  }
  int64_t rays = 0, hits = 0;
  for (const Worker& w : workers) rays += w.rays, hits += w.hits;
  log.count("gather_rays", rays);
  log.count("gather_points", hits);
  log.count("gather_samples", static_cast<int64_t>(out.samples.size()));
  return out;
}

}  // namespace relight::clustered_gather
