#include "common/sampling/importance_map.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "common/image/luminance.h"
#include "common/sampling/random.h"
#include "common/scene/topology.h"

namespace relight {
namespace {

constexpr uint64_t stream = 0x11fe51de5ull;

// Layers a cell. More would tell thinner slabs apart and need more particles on slanted surfaces, which cross
// many.
constexpr float layers = 32.0f;

struct Particle {
  uint64_t bin, layer;
  float weight;  // 0: no hit
};

int main_axis(const glm::vec3& n) {
  const glm::vec3 a = glm::abs(n);
  return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

struct Scattered {
  glm::vec3 direction;
  float reflected;  // luminance of BRDF x cosine / density
};

// A direction by the whole BRDF of a view sample.
Scattered scatter(const SurfaceSample& at, const glm::vec3& eye, float u_lobe, const glm::vec2& u) {
  const glm::vec3 n = at.shading_normal, wo = glm::normalize(eye - at.position);
  const BrdfSample sample = sample_brdf(at.brdf(), n, wo, u_lobe, u, false);
  const float cosine = glm::dot(n, sample.wi);
  if (!(sample.pdf > 0.0f) || !(cosine > 0.0f)) return {n, 0.0f};
  return {sample.wi, luminance(shader::brdf_eval(at.brdf(), n, wo, sample.wi)) * cosine / sample.pdf};
}

}  // namespace

ImportanceMap::ImportanceMap(const RayTracer& tracer, const CloudView& view, int64_t particles, float cell,
                             uint64_t seed)
    : scene_(tracer.scene()),
      cell_(cell),
      component_(connected_components(weld_positions(tracer.scene().positions), tracer.scene().triangles)) {
  const DeepFrameBuffer& buffer = view.buffer;
  const auto length = static_cast<size_t>(view.bounces);
  std::vector<Particle> hits(static_cast<size_t>(particles) * length, Particle{0, 0, 0.0f});
  const auto shoot = [&](int64_t p) {
    const auto number = static_cast<uint64_t>(p);
    SurfaceSample at = buffer.indirect[random_bits(seed, stream, number, 0) % buffer.indirect.size()];
    float weight = 1.0f;
    for (size_t b = 0; b < length && at.valid; ++b) {
      const glm::vec2 u(random_float(seed, stream, number, 2 * b + 1),
                        random_float(seed, stream, number, 2 * b + 2));
      const bool lobes = b == 0 && view.glossy && at.glossy != glm::vec3(0.0f);
      const auto [direction, reflected] =
          lobes ? scatter(at, buffer.view.camera.eye, random_float(seed, stream, number, 2 * length + 1), u)
                : Scattered{sample_cosine(at.shading_normal, u), luminance(at.diffuse)};
      weight *= reflected;
      if (!(weight > 0.0f) || glm::dot(direction, at.geometric_normal) <= 0.0f) return;
      const Hit hit = tracer.intersect(tracer.offset_point(at.position, at.geometric_normal), direction);
      if (!hit.valid) return;
      at = tracer.surface(hit, direction);
      const bool flipped = glm::dot(scene_.area_normal(at.triangle), at.geometric_normal) < 0.0f;
      const uint64_t key = bin(at.position, at.triangle, flipped);
      hits[static_cast<size_t>(p) * length + b] = {key, layer(key, at.position, at.triangle), weight};
    }
  };
  if (buffer.indirect.empty()) return;
  tbb::parallel_for(int64_t{0}, particles, shoot);
  for (const Particle& hit : hits) {  // in order: the sums must not depend on the number of threads
    if (hit.weight == 0.0f) continue;
    weights_[hit.bin] += static_cast<double>(hit.weight);
    reached_.insert(hit.layer);
    total_ += static_cast<double>(hit.weight);
  }
}

uint64_t ImportanceMap::bin(const glm::vec3& position, uint32_t triangle, bool flipped) const {
  const glm::vec3 n = flipped ? -scene_.area_normal(triangle) : scene_.area_normal(triangle);
  const int axis = main_axis(n);
  const auto direction = static_cast<uint64_t>(2 * axis + (n[axis] < 0.0f ? 1 : 0));
  // Points of a face that lies on the border between two cells are rounded to either: shifted by an odd
  // fraction of a cell, which makes axis-aligned faces on a border unlikely; a face cut in two costs only
  // noise.
  const auto coordinate = [&](int d) {
    return static_cast<uint64_t>(
        std::max(0.0f, std::floor((position[d] - scene_.bounds.lo[d]) / cell_ + 0.37f)));
  };
  uint64_t key = hash_combine(component_[triangle], flipped ? 1 : 0);
  for (int d = 0; d < 3; ++d) key = hash_combine(key, coordinate(d));
  return hash_combine(key, direction);
}

uint64_t ImportanceMap::layer(uint64_t bin, const glm::vec3& position, uint32_t triangle) const {
  const int axis = main_axis(scene_.area_normal(triangle));
  const float height = (position[axis] - scene_.bounds.lo[axis]) / cell_;
  return hash_combine(bin, static_cast<uint64_t>(std::max(0.0f, std::floor(height * layers + 0.37f))));
}

bool ImportanceMap::reached(const glm::vec3& position, uint32_t triangle, bool flipped) const {
  return reached_.contains(layer(bin(position, triangle, flipped), position, triangle));
}

double ImportanceMap::weight(uint64_t bin) const {
  const auto found = weights_.find(bin);
  return found == weights_.end() ? 0.0 : found->second;
}

}  // namespace relight
