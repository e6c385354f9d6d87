#include "common/sampling/gather_cloud.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>

#include "common/run/error.h"
#include "common/sampling/random.h"

namespace relight {
namespace {

constexpr uint64_t stream = 0x6a74e2ull;
constexpr size_t parallel_grain = 4096;  // smaller subsets are not worth a task

double weight_of(const SurfacePiece& p) {
  return static_cast<double>(p.area) * static_cast<double>(p.importance);
}

double total_weight(std::span<const SurfacePiece> pieces) {
  double sum = 0.0;
  for (const SurfacePiece& p : pieces) sum += weight_of(p);
  return sum;
}

class Sampler {
 public:
  Sampler(const RayTracer& tracer, uint64_t seed, GatherCloud& cloud)
      : tracer_(tracer), seed_(seed), cloud_(cloud) {}

  // Samples `pieces` into cloud[first, first + budget).
  void sample(std::span<SurfacePiece> pieces, int64_t budget, int64_t first) {
    if (pieces.size() == 1) return sample_one_piece(pieces[0], budget, first);
    const double weight = total_weight(pieces);
    if (budget == 1) {
      const SurfacePiece& piece = pick_by_weight(pieces, weight, first);
      // Picked with probability weight_of(piece) / weight: stands for its area by that share.
      place(piece, glm::vec2(random(first, 1), random(first, 2)), first,
            weight / static_cast<double>(piece.importance));
      return;
    }
    const size_t middle = split_by_weight(pieces, weight);
    const double left_weight = total_weight(pieces.first(middle));
    const auto share = static_cast<int64_t>(std::llround(static_cast<double>(budget) * left_weight / weight));
    const int64_t left_budget = std::clamp<int64_t>(share, 1, budget - 1);
    const auto left = [&, this] { sample(pieces.first(middle), left_budget, first); };
    const auto right = [&, this] {
      sample(pieces.subspan(middle), budget - left_budget, first + left_budget);
    };
    if (pieces.size() > parallel_grain)
      tbb::parallel_invoke(left, right);
    else
      left(), right();
  }

 private:
  float random(int64_t index, uint64_t dimension) const {
    return random_float(seed_, stream, static_cast<uint64_t>(index), dimension);
  }

  void sample_one_piece(const SurfacePiece& piece, int64_t budget, int64_t first) {
    const uint64_t scramble = random_bits(seed_, stream, static_cast<uint64_t>(first), 3);
    for (int64_t i = 0; i < budget; ++i)
      place(piece, sobol_2d(static_cast<uint32_t>(i), scramble), first + i,
            static_cast<double>(piece.area) / static_cast<double>(budget));
  }

  const SurfacePiece& pick_by_weight(std::span<const SurfacePiece> pieces, double weight,
                                     int64_t index) const {
    double target = static_cast<double>(random(index, 0)) * weight;
    for (const SurfacePiece& p : pieces) {
      target -= weight_of(p);
      if (target < 0.0) return p;
    }
    return pieces.back();
  }

  // Sorts along the longest axis of the centroids; returns the index that halves the weight (1 .. size - 1).
  static size_t split_by_weight(std::span<SurfacePiece> pieces, double weight) {
    Bounds box;
    for (const SurfacePiece& p : pieces) box.add(p.centroid);
    const glm::vec3 extent = box.hi - box.lo;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    // A total order, so that the result does not depend on the sorting algorithm's threads.
    const auto key = [axis](const SurfacePiece& p) {
      return std::tuple(p.centroid[axis], p.triangle, p.corner[0].x, p.corner[0].y, p.corner[1].x,
                        p.corner[1].y, p.flipped);
    };
    const auto less = [&key](const SurfacePiece& a, const SurfacePiece& b) { return key(a) < key(b); };
    if (pieces.size() > parallel_grain)
      tbb::parallel_sort(pieces.begin(), pieces.end(), less);
    else
      std::sort(pieces.begin(), pieces.end(), less);
    double sum = 0.0;
    size_t middle = 0;
    while (middle < pieces.size() - 1 && sum + 0.5 * weight_of(pieces[middle]) < 0.5 * weight)
      sum += weight_of(pieces[middle++]);
    return std::max<size_t>(middle, 1);
  }

  void place(const SurfacePiece& piece, const glm::vec2& u, int64_t index, double area) {
    // Area-preserving map of the unit square to a triangle.
    const float root = std::sqrt(u.x), b = root * (1.0f - u.y), c = root * u.y;
    const glm::vec2 uv =
        piece.corner[0] + b * (piece.corner[1] - piece.corner[0]) + c * (piece.corner[2] - piece.corner[0]);
    const Hit hit{.triangle = piece.triangle, .t = 0.0f, .u = uv.x, .v = uv.y, .valid = true};
    const glm::vec3 normal = tracer_.scene().area_normal(piece.triangle);
    const auto i = static_cast<size_t>(index);
    cloud_.samples[i] = tracer_.surface(hit, piece.flipped ? normal : -normal);
    cloud_.area[i] = static_cast<float>(area);
  }

  const RayTracer& tracer_;
  uint64_t seed_;
  GatherCloud& cloud_;
};

// Hits of particles for each sample: a layer of a cell of average importance gets some thirty, if the surface
// crosses all 32 layers, and a place of a twentieth of the average still one or two. With more bounces each
// particle hits as many times more. The most are what 65,536 samples take, the least keep a rough map.
constexpr int64_t hits_a_sample = 128, most_hits = 1 << 23, least_hits = 1 << 18;
// A cell is large enough for this many samples of a uniform cloud: small enough to follow visibility, large
// enough to count.
constexpr double samples_a_cell = 8.0;
// No sample stands for more than 1/least times the area of an average one: rarely seen places may still be
// lit strongly.
constexpr float least_importance = 0.05f;

}  // namespace

GatherCloud make_gather_cloud(const RayTracer& tracer, std::vector<SurfacePiece>& pieces, int64_t budget,
                              uint64_t seed) {
  if (budget < 1) fail("gather cloud: {} samples asked for, at least 1 needed", budget);
  if (pieces.empty() || !(total_weight(pieces) > 0.0))
    fail("gather cloud: scene '{}' has no surface with an area", tracer.scene().name);
  GatherCloud cloud;
  cloud.samples.resize(static_cast<size_t>(budget));
  cloud.area.resize(static_cast<size_t>(budget));
  Sampler(tracer, seed, cloud).sample(pieces, budget, 0);
  return cloud;
}

GatherCloud make_gather_cloud_for_view(const RayTracer& tracer, const CloudView& view, CloudSampling sampling,
                                       int64_t budget, uint64_t seed) {
  const Scene& scene = tracer.scene();
  double surface = 0.0;
  for (size_t t = 0; t < scene.triangles.size(); ++t)
    surface += 0.5 * glm::length(glm::dvec3(scene.area_normal(t)));
  if (!(surface > 0.0)) fail("gather cloud: scene '{}' has no surface with an area", scene.name);
  const double cell_area = samples_a_cell * surface / static_cast<double>(budget);
  std::vector<SurfacePiece> pieces = cut_surfaces(scene, 0.25 * cell_area);
  const int64_t hits = std::clamp(hits_a_sample * budget, least_hits, most_hits);
  const ImportanceMap map(tracer, view, hits / view.bounces, static_cast<float>(std::sqrt(cell_area)), seed);
  apply_importance(pieces, map, least_importance, sampling == CloudSampling::uniform);
  return make_gather_cloud(tracer, pieces, budget, seed);
}

}  // namespace relight
