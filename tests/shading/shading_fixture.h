// A small world for shading tests: a hand-made scene, samples on all its surfaces and both their sides,
// lights.
#pragma once

#include <vector>

#include "common/gpu/context.h"
#include "common/run/stage_log.h"
#include "common/sampling/surface_sample.h"
#include "common/scene/scene.h"
#include "common/shading/direct_lighting.h"
#include "common/tracing/ray_tracer.h"

namespace relight::test {

// A room of 4 x 3 x 4 around the origin with boxes, a glossy sphere and a thin floating slab, every vertex
// mapped to scale * p + shift.
Scene room_scene(float scale = 1.0f, const glm::vec3& shift = glm::vec3(0.0f));

// n points, area-weighted over the triangles, each seen from a random side.
std::vector<SurfaceSample> random_samples(const RayTracer& tracer, int n, uint64_t seed = 1);

Light omni_light(const glm::vec3& position);
Light spot_light(const glm::vec3& position, const glm::vec3& direction, float outer_degrees);

// Shades one set and downloads it.
std::vector<glm::vec3> shade(DirectLighting& shading, const std::vector<SurfaceSample>& samples,
                             const glm::vec3& eye, const LightingState& lighting, Lobes lobes, StageLog& log);

// For each sample a bound on what any rounding of its radiance can refer to: peak BRDF times unshadowed,
// unsmoothed irradiance, summed over the lights.
std::vector<float> rounding_scale(const std::vector<SurfaceSample>& samples, const LightingState& lighting);

// Largest |a - b| / scale over all samples and channels; infinite if a value is not finite.
float largest_error(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b,
                    const std::vector<float>& scale);

}  // namespace relight::test
