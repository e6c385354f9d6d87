#include "methods/clustered_gather/gather_samples.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "common/brdf/brdf.h"
#include "common/run/error.h"
#include "common/sampling/environment_samples.h"
#include "common/sampling/random.h"
#include "methods/clustered_gather/environment_shares.h"
#include "methods/clustered_gather/representative.h"

namespace relight::clustered_gather {
namespace {

constexpr uint64_t stream = 0x67617468657231ull;

struct Worker {
  std::vector<SurfaceSample> points;
  std::vector<glm::vec3> weights;
  std::vector<Point6> points6;
  std::vector<Miss> misses;
  int64_t rays = 0, hits = 0, misses_kept = 0;
};

struct Direction {
  glm::vec3 wi;
  glm::vec3 weight;  // of the radiance from there, times the number of directions
};

Direction diffuse_direction(const SurfaceSample& from, const glm::vec2& u) {
  return {sample_cosine(from.shading_normal, u), glm::vec3(1.0f)};
}

// Weight 0 where nothing is reflected from that direction.
Direction glossy_direction(const SurfaceSample& from, const glm::vec3& eye, float u_lobe,
                           const glm::vec2& u) {
  const shader::BrdfParams brdf = from.brdf();
  const glm::vec3 n = from.shading_normal, wo = glm::normalize(eye - from.position);
  const glm::vec3 wi = glm::normalize(shader::brdf_glossy_sample(brdf, n, wo, u_lobe, u));
  const float cosine = glm::dot(n, wi), density = shader::brdf_glossy_pdf(brdf, n, wo, wi);
  if (!(cosine > 0.0f) || !(density > 0.0f)) return {wi, glm::vec3(0.0f)};
  return {wi, shader::brdf_glossy(brdf, n, wo, wi) * (cosine / density)};
}

// What gather samples are lit by: a glossy part would be kept, uploaded and never read.
SurfaceSample lambert(SurfaceSample s) {
  s.glossy = s.emission = glm::vec3(0.0f);
  s.exponent = 1.0f;
  s.shape = {};
  return s;
}

// The points that directions from the view cluster hit. Points that reflect nothing diffusely are kept: they
// are part of what the clusters must cover, and removing them would be a clustering of its own.
// square: null if directions that hit nothing are black.
void trace(const RayTracer& tracer, const SurfaceSample& from, uint64_t scramble,
           const GatherSettings& settings, const EnvironmentSquare* square, Worker& worker) {
  worker.points.clear(), worker.weights.clear(), worker.misses.clear();
  const glm::vec3 origin = tracer.offset_point(from.position, from.geometric_normal);
  const float share = 1.0f / static_cast<float>(settings.directions);
  for (uint32_t i = 0; i < static_cast<uint32_t>(settings.directions); ++i) {
    const glm::vec2 u = sobol_2d(i, scramble);
    const Direction d = settings.part == Part::diffuse
                            ? diffuse_direction(from, u)
                            : glossy_direction(from, settings.eye, random_float(scramble, stream, i, 1), u);
    if (d.weight == glm::vec3(0.0f) || !(glm::dot(d.wi, from.geometric_normal) > 0.0f)) continue;
    ++worker.rays;
    const Hit hit = tracer.intersect(origin, d.wi);
    if (!hit.valid && square) worker.misses.push_back({square->texel_of(d.wi), d.weight * share});
    if (!hit.valid) continue;
    worker.points.push_back(lambert(tracer.surface(hit, d.wi)));
    worker.weights.push_back(d.weight * share);
  }
  worker.hits += static_cast<int64_t>(worker.points.size());
  worker.misses_kept += static_cast<int64_t>(worker.misses.size());
}

// Of the clusters of a view cluster, those for environment samples: in proportion to weight, and one at least
// for either kind that there is. 0: no limit, or no such samples.
size_t environment_clusters(const Worker& worker, size_t clusters) {
  if (worker.misses.empty() || clusters == 0) return 0;
  const auto sum = [](double before, const glm::vec3& w) {
    return before + static_cast<double>(w.x + w.y + w.z);
  };
  double seen = 0.0, missed = 0.0;
  for (const glm::vec3& w : worker.weights) seen = sum(seen, w);
  for (const Miss& m : worker.misses) missed = sum(missed, m.weight);
  if (worker.points.empty()) return clusters;
  const auto share =
      static_cast<size_t>(std::lround(static_cast<double>(clusters) * missed / (seen + missed)));
  return std::clamp<size_t>(share, 1, std::max<size_t>(clusters - 1, 1));
}

// One gather sample for each cluster of the points, diffuse albedo = sum of weight x albedo of the members.
std::vector<LambertSample> reduce(Worker& worker, const Metric6& metric, const GatherSettings& settings,
                                  size_t clusters, uint64_t seed) {
  const size_t limit = clusters == 0 ? worker.points.size() : clusters;
  if (worker.points.size() <= limit) {
    std::vector<LambertSample> all;
    all.reserve(worker.points.size());
    for (size_t i = 0; i < worker.points.size(); ++i) {
      all.push_back(lambert_part(worker.points[i]));
      all.back().diffuse *= worker.weights[i];
    }
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
  std::vector<LambertSample> reduced;
  reduced.reserve(clustering.centres.size());
  for (size_t k = 0; k < clustering.centres.size(); ++k) {
    reduced.push_back(lambert_part(representative(worker.points, members.of(k))));
    glm::dvec3 albedo(0.0);
    for (const uint32_t i : members.of(k))
      albedo += glm::dvec3(worker.points[i].diffuse) * glm::dvec3(worker.weights[i]);
    reduced.back().diffuse = glm::vec3(albedo);
  }
  return reduced;
}

void append_rows(const std::vector<std::vector<SparseEntryRgb>>& rows, uint32_t columns, SparseRowsRgb& out) {
  if (out.row_start.empty()) out.row_start.push_back(0);
  out.columns = columns;
  for (const auto& row : rows) {
    out.entries.insert(out.entries.end(), row.begin(), row.end());
    out.row_start.push_back(out.entries.size());
  }
}

}  // namespace

LambertSample lambert_part(const SurfaceSample& s) {
  return {s.position, s.shading_normal, s.geometric_normal, s.diffuse};
}

SurfaceSample surface_sample(const LambertSample& kept) {
  SurfaceSample s;
  s.position = kept.position, s.diffuse = kept.diffuse;
  s.shading_normal = kept.shading_normal, s.geometric_normal = kept.geometric_normal;
  s.valid = true;
  return s;
}

void add_gather_samples(const RayTracer& tracer, const ViewClusters& view, const Metric6& metric,
                        const GatherSettings& settings, Progress& progress, StageLog& log,
                        GatherSamples& out) {
  std::vector<std::vector<LambertSample>> reduced(view.samples.size());
  std::optional<EnvironmentSquare> square;
  if (settings.environment_samples > 0) square.emplace(settings.environment_samples);
  const int levels = square ? std::bit_width(square->texels()) / 2 : 0;
  std::vector<std::vector<SparseEntryRgb>> environment(square ? view.samples.size() : 0);
  tbb::enumerable_thread_specific<Worker> workers;
  const bool glossy = settings.part == Part::glossy;
  progress.start(glossy ? "glossy gather samples" : "gather samples",
                 static_cast<int64_t>(view.samples.size()));
  tbb::parallel_for(size_t{0}, view.samples.size(), [&](size_t k) {
    progress.advance();
    if (!settings.used.empty() && !settings.used[k]) return;
    Worker& worker = workers.local();
    const uint64_t scramble = random_bits(settings.seed, stream, k, glossy ? 1 : 0);
    trace(tracer, view.samples[k], scramble, settings, square ? &*square : nullptr, worker);
    const size_t of_environment = environment_clusters(worker, settings.clusters);
    if (square) environment[k] = environment_samples(worker.misses, levels, of_environment);
    const size_t of_surfaces =
        settings.clusters == 0 ? 0 : std::max<size_t>(settings.clusters - of_environment, 1);
    reduced[k] = reduce(worker, metric, settings, of_surfaces, scramble);
  });
  progress.finish();
  const size_t before = out.samples.size();
  size_t total = before;
  for (const auto& r : reduced) total += r.size();
  if (total >= (size_t{1} << 32)) fail("clustered_gather: {} gather samples; at most 2^32 - 1", total);
  out.samples.reserve(total);
  for (auto& r : reduced) {
    for (const LambertSample& s : r) out.samples.push_back(surface_sample(s));
    out.first.push_back(static_cast<uint32_t>(out.samples.size()));
    r = {};
  }
  if (square) append_rows(environment, pyramid_begin(levels + 1), out.environment);
  int64_t rays = 0, hits = 0, misses = 0;
  for (const Worker& w : workers) rays += w.rays, hits += w.hits, misses += w.misses_kept;
  const std::string prefix = glossy ? "glossy_" : "";
  log.count(prefix + "gather_rays", rays);
  log.count(prefix + "gather_points", hits);
  log.count(prefix + "gather_samples", static_cast<int64_t>(total - before));
  if (!square) return;
  int64_t samples = 0;
  for (const auto& row : environment) samples += static_cast<int64_t>(row.size());
  log.count("environment_misses", misses);
  log.count("environment_samples", samples);
}

}  // namespace relight::clustered_gather
