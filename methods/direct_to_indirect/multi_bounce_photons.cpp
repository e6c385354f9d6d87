#include "methods/direct_to_indirect/multi_bounce_photons.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "common/brdf/brdf.h"
#include "common/image/luminance.h"
#include "common/sampling/random.h"

namespace relight::direct_to_indirect {
namespace {

constexpr uint64_t stream = 0x9407045ull;

// The ratio of cosines has no bound at grazing angles, where few photons arrive: above this it would be
// noise. For shading normals 17 degrees off, less than 0.1 % of the light is lost by it.
constexpr float largest_cosine_ratio = 10.0f;

// What one gather sample's photons leave behind.
struct Shot {
  std::vector<Photon> hits;
  std::vector<double> power;
  int64_t rays = 0;
};

class Shooter {
 public:
  Shooter(const MultiBounceInput& input, const MultiBounceSettings& settings, uint32_t photons)
      : in_(input),
        seed_(settings.gather.seed),
        length_(static_cast<size_t>(settings.bounces) - 1),
        n_(photons) {}

  Shot shoot(uint32_t source) const {
    Shot out;
    out.power.assign(length_ + 1, 0.0);
    out.hits.reserve(n_ * length_);
    for (uint32_t p = 0; p < n_; ++p) trace(source, p, out);
    return out;
  }

 private:
  void trace(uint32_t source, uint32_t p, Shot& out) const {
    SurfaceSample at = in_.cloud.samples[source];
    glm::vec3 area(in_.cloud.area[source] / static_cast<float>(n_));
    out.power[0] += static_cast<double>(area.x);
    for (size_t hit = 1; hit <= length_; ++hit) {
      const glm::vec2 u = sobol_2d(p, random_bits(seed_, stream, source, hit));
      const glm::vec3 direction = sample_cosine(at.geometric_normal, u);
      ++out.rays;
      const Hit found =
          in_.tracer.intersect(in_.tracer.offset_point(at.position, at.geometric_normal), direction);
      if (!found.valid) return;
      at = in_.tracer.surface(found, direction);
      const float cos_s = -glm::dot(direction, at.shading_normal),
                  cos_g = -glm::dot(direction, at.geometric_normal);
      if (!(cos_s > 0.0f && cos_g > 0.0f)) return;
      area *= std::min(cos_s / cos_g, largest_cosine_ratio);
      out.hits.push_back({at.position, source, at.geometric_normal, area});
      area *= at.diffuse;
      if (area == glm::vec3(0.0f)) return;
      out.power[hit] += luminance(glm::dvec3(area));
    }
  }

  const MultiBounceInput& in_;
  uint64_t seed_;
  size_t length_;
  uint32_t n_;
};

}  // namespace

PhotonMap trace_photons(const MultiBounceInput& input, const MultiBounceSettings& settings) {
  const size_t samples = input.cloud.samples.size();
  const auto each = std::max<int64_t>(
      1, std::llround(static_cast<double>(settings.photons) / static_cast<double>(samples)));
  const Shooter shooter(input, settings, static_cast<uint32_t>(each));
  std::vector<Shot> shots(samples);
  tbb::parallel_for(size_t{0}, samples,
                    [&](size_t j) { shots[j] = shooter.shoot(static_cast<uint32_t>(j)); });

  PhotonMap map;
  map.shot = each * static_cast<int64_t>(samples);
  map.power.assign(static_cast<size_t>(settings.bounces), 0.0);
  size_t hits = 0;
  for (const Shot& shot : shots) hits += shot.hits.size();
  map.photons.reserve(hits);
  for (const Shot& shot : shots) {  // in order: the sums must not depend on the number of threads
    map.photons.insert(map.photons.end(), shot.hits.begin(), shot.hits.end());
    map.rays += shot.rays;
    for (size_t k = 0; k < shot.power.size(); ++k) map.power[k] += shot.power[k];
  }
  return map;
}

}  // namespace relight::direct_to_indirect
