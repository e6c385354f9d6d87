#include "common/sampling/gather_cloud.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>

#include "common/run/error.h"
#include "common/sampling/random.h"

namespace relight {
namespace {

constexpr uint64_t stream = 0x6a74e2ull;
constexpr size_t parallel_grain = 4096;  // smaller subsets are not worth a task

// One live side of a triangle.
struct Side {
  uint32_t triangle;
  bool flipped;  // the side away from the area normal
  float area;
  glm::vec3 centroid;
};

std::vector<Side> collect_sides(const Scene& scene, const LiveSides& live) {
  std::vector<Side> sides;
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const Triangle& tri = scene.triangles[t];
    const float area = 0.5f * glm::length(scene.area_normal(t));
    if (!(area > 0.0f)) continue;
    const glm::vec3 centroid =
        (scene.positions[tri.v[0]] + scene.positions[tri.v[1]] + scene.positions[tri.v[2]]) / 3.0f;
    if (live.sides[t] & 1) sides.push_back({static_cast<uint32_t>(t), false, area, centroid});
    if (live.sides[t] & 2) sides.push_back({static_cast<uint32_t>(t), true, area, centroid});
  }
  return sides;
}

double total_area(std::span<const Side> sides) {
  double sum = 0.0;
  for (const Side& s : sides) sum += s.area;
  return sum;
}

class Sampler {
 public:
  Sampler(const RayTracer& tracer, uint64_t seed, GatherCloud& cloud)
      : tracer_(tracer), seed_(seed), cloud_(cloud) {}

  // Samples `sides` into cloud[first, first + budget).
  void sample(std::span<Side> sides, int64_t budget, int64_t first) {
    if (sides.size() == 1) return sample_one_side(sides[0], budget, first);
    const double area = total_area(sides);
    if (budget == 1) {
      const Side& side = pick_by_area(sides, area, first);
      place(side, glm::vec2(random(first, 1), random(first, 2)), first, area);
      return;
    }
    const size_t middle = split_by_area(sides, area);
    const double left_area = total_area(sides.first(middle));
    const auto share = static_cast<int64_t>(std::llround(static_cast<double>(budget) * left_area / area));
    const int64_t left_budget = std::clamp<int64_t>(share, 1, budget - 1);
    const auto left = [&, this] { sample(sides.first(middle), left_budget, first); };
    const auto right = [&, this] {
      sample(sides.subspan(middle), budget - left_budget, first + left_budget);
    };
    if (sides.size() > parallel_grain)
      tbb::parallel_invoke(left, right);
    else
      left(), right();
  }

 private:
  float random(int64_t index, uint64_t dimension) const {
    return random_float(seed_, stream, static_cast<uint64_t>(index), dimension);
  }

  void sample_one_side(const Side& side, int64_t budget, int64_t first) {
    const uint64_t scramble = random_bits(seed_, stream, side.triangle, side.flipped ? 4 : 3);
    for (int64_t i = 0; i < budget; ++i)
      place(side, sobol_2d(static_cast<uint32_t>(i), scramble), first + i,
            static_cast<double>(side.area) / static_cast<double>(budget));
  }

  const Side& pick_by_area(std::span<const Side> sides, double area, int64_t index) const {
    double target = static_cast<double>(random(index, 0)) * area;
    for (const Side& s : sides) {
      target -= s.area;
      if (target < 0.0) return s;
    }
    return sides.back();
  }

  // Sorts along the longest axis of the centroids; returns the index that halves the area (1 .. size - 1).
  static size_t split_by_area(std::span<Side> sides, double area) {
    Bounds box;
    for (const Side& s : sides) box.add(s.centroid);
    const glm::vec3 extent = box.hi - box.lo;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto less = [axis](const Side& a, const Side& b) {
      return std::tie(a.centroid[axis], a.triangle, a.flipped) <
             std::tie(b.centroid[axis], b.triangle, b.flipped);
    };
    if (sides.size() > parallel_grain)
      tbb::parallel_sort(sides.begin(), sides.end(), less);
    else
      std::sort(sides.begin(), sides.end(), less);
    double sum = 0.0;
    size_t middle = 0;
    while (middle < sides.size() - 1 && sum + 0.5 * sides[middle].area < 0.5 * area)
      sum += sides[middle++].area;
    return std::max<size_t>(middle, 1);
  }

  void place(const Side& side, const glm::vec2& u, int64_t index, double area) {
    // Area-preserving map of the unit square to barycentrics.
    const float root = std::sqrt(u.x);
    const Hit hit{
        .triangle = side.triangle, .t = 0.0f, .u = root * (1.0f - u.y), .v = root * u.y, .valid = true};
    const glm::vec3 normal = tracer_.scene().area_normal(side.triangle);
    const auto i = static_cast<size_t>(index);
    cloud_.samples[i] = tracer_.surface(hit, side.flipped ? normal : -normal);
    cloud_.area[i] = static_cast<float>(area);
  }

  const RayTracer& tracer_;
  uint64_t seed_;
  GatherCloud& cloud_;
};

}  // namespace

GatherCloud make_uniform_gather_cloud(const RayTracer& tracer, const LiveSides& live, int64_t budget,
                                      uint64_t seed) {
  std::vector<Side> sides = collect_sides(tracer.scene(), live);
  if (sides.empty()) fail("gather cloud: scene '{}' has no surface with an area", tracer.scene().name);
  if (budget < 1) fail("gather cloud: {} samples asked for, at least 1 needed", budget);
  GatherCloud cloud;
  cloud.samples.resize(static_cast<size_t>(budget));
  cloud.area.resize(static_cast<size_t>(budget));
  Sampler(tracer, seed, cloud).sample(sides, budget, 0);
  return cloud;
}

}  // namespace relight
