#include "tests/shading/shading_fixture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/sampling/random.h"
#include "tests/support/tiny_scenes.h"

namespace relight::test {

Scene room_scene(float scale, const glm::vec3& shift) {
  Scene scene = tiny::empty_scene(glm::vec3(0.6f, 0.5f, 0.4f));
  Material glossy;
  glossy.diffuse = glm::vec3(0.2f, 0.3f, 0.4f);
  glossy.glossy = glm::vec3(0.5f);
  glossy.exponent = 8.0f;
  const uint32_t shiny = tiny::add_material(scene, glossy);
  tiny::add_box(scene, {-2, -1, -2}, {2, 2, 2});
  tiny::add_box(scene, {-1.4f, -1, -1.1f}, {-0.6f, 0.3f, -0.3f});
  tiny::add_box(scene, {0.5f, -0.2f, -0.6f}, {1.5f, -0.18f, 0.6f});
  tiny::add_sphere(scene, {0.1f, -0.5f, 0.8f}, 0.5f, 12, shiny);
  for (glm::vec3& p : scene.positions) p = scale * p + shift;
  finish_scene(scene);
  return scene;
}

std::vector<SurfaceSample> random_samples(const RayTracer& tracer, int n, uint64_t seed) {
  const Scene& scene = tracer.scene();
  std::vector<double> areas;
  double total = 0.0;
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    areas.push_back(total += static_cast<double>(glm::length(scene.area_normal(t))));
  }
  std::vector<SurfaceSample> samples;
  for (uint64_t i = 0; i < static_cast<uint64_t>(n); ++i) {
    const auto u = [&](uint64_t dimension) { return random_float(seed, 7, i, dimension); };
    const auto chosen = std::upper_bound(areas.begin(), areas.end(), static_cast<double>(u(0)) * total);
    const auto triangle = static_cast<uint32_t>(
        std::min<size_t>(static_cast<size_t>(chosen - areas.begin()), scene.triangles.size() - 1));
    const float root = std::sqrt(u(1));
    const Hit hit{triangle, 1.0f, root * (1.0f - u(2)), root * u(2), true};
    const glm::vec3 towards = scene.area_normal(triangle) * (u(3) < 0.5f ? 1.0f : -1.0f);
    samples.push_back(tracer.surface(hit, towards));
  }
  return samples;
}

Light omni_light(const glm::vec3& position) {
  Light light;
  light.name = "omni";
  light.position = position;
  light.intensity = glm::vec3(3, 2, 1);
  return light;
}

Light spot_light(const glm::vec3& position, const glm::vec3& direction, float outer_degrees) {
  Light light = omni_light(position);
  light.name = "spot";
  light.type = LightType::spot;
  light.direction = direction;
  light.outer_degrees = outer_degrees;
  light.inner_degrees = 0.7f * outer_degrees;
  return light;
}

std::vector<glm::vec3> shade(DirectLighting& shading, const std::vector<SurfaceSample>& samples,
                             const glm::vec3& eye, const LightingState& lighting, Lobes lobes,
                             StageLog& log) {
  const GpuSamples on_gpu(samples, eye);
  gpu::Buffer out(static_cast<int64_t>(16 * samples.size()));
  shading.shade(lighting, {{&on_gpu, lobes, &out}}, log);
  const std::vector<glm::vec4> values = out.download<glm::vec4>();
  return {values.begin(), values.end()};
}

std::vector<float> rounding_scale(const std::vector<SurfaceSample>& samples, const LightingState& lighting) {
  const auto largest = [](const glm::vec3& v) { return std::max({v.x, v.y, v.z}); };
  std::vector<float> scale(samples.size(), std::numeric_limits<float>::min());
  for (const Light& light : lighting.lights) {
    const shader::LightParams params = light.params();
    const float cone = params.intensity_inner.w - params.direction_outer.w;
    const float sharpness = light.type == LightType::spot ? 1.5f / cone : 1.0f;
    for (size_t i = 0; i < samples.size(); ++i) {
      const SurfaceSample& s = samples[i];
      const glm::vec3 to_light = light.position - s.position;
      const float peak = largest(s.diffuse) + largest(s.glossy) * (s.exponent + 2.0f) * (1.0f + s.exponent);
      const float r2 = std::max(glm::dot(to_light, to_light), std::numeric_limits<float>::min());
      scale[i] += peak * largest(light.intensity) * sharpness / r2;
    }
  }
  return scale;
}

float largest_error(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b,
                    const std::vector<float>& scale) {
  float worst = 0.0f;
  for (size_t i = 0; i < a.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (!std::isfinite(a[i][c]) || !std::isfinite(b[i][c])) return std::numeric_limits<float>::infinity();
      worst = std::max(worst, std::abs(a[i][c] - b[i][c]) / scale[i]);
    }
  }
  return worst;
}

}  // namespace relight::test
