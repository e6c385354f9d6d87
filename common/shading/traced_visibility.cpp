#include "common/shading/traced_visibility.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <bit>

#include "common/tracing/ray_tracer.h"

namespace relight {
namespace {

// 16 neighbours at once: they run towards one light and so form a coherent packet.
uint32_t visible_of_16(const RayTracer& tracer, const SurfaceSample* samples, size_t count,
                       const Emitter& light, uint32_t& traced) {
  glm::vec3 origins[16];
  traced = 0;
  for (size_t i = 0; i < count; ++i) {
    const SurfaceSample& s = samples[i];
    if (!s.valid) continue;
    if (light.irradiance(s.position, s.shading_normal, s.geometric_normal) == glm::vec3(0.0f)) continue;
    traced |= 1u << i;
    origins[i] = tracer.offset_point(s.position, s.geometric_normal);  // a lit sample faces the light
  }
  return traced ? visible16(tracer, origins, light, traced) : 0u;
}

}  // namespace

uint32_t visible16(const RayTracer& tracer, const glm::vec3* origins, const Emitter& light, uint32_t active) {
  if (!light.is_directional()) return tracer.visible16(origins, light.position(), active);
  return tracer.visible16_along(origins, light.axis() * (-2.0f * tracer.scene().bounds.diagonal()), active);
}

std::vector<uint32_t> traced_visibility(const RayTracer& tracer, const std::vector<SurfaceSample>& samples,
                                        const Emitter& light, int64_t& rays) {
  const size_t words = (samples.size() + 31) / 32;
  std::vector<uint32_t> visible(words), traced(words);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, words, 64), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t w = range.begin(); w < range.end(); ++w) {
      for (unsigned half = 0; half < 2; ++half) {
        const size_t first = w * 32 + half * 16;
        if (first >= samples.size()) break;
        const size_t count = std::min<size_t>(16, samples.size() - first);
        uint32_t mask = 0;
        visible[w] |= visible_of_16(tracer, &samples[first], count, light, mask) << (half * 16);
        traced[w] |= mask << (half * 16);
      }
    }
  });
  for (const uint32_t mask : traced) rays += std::popcount(mask);
  return visible;
}

}  // namespace relight
