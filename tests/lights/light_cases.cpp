#include "tests/lights/light_cases.h"

#include <algorithm>
#include <limits>

#include "common/sampling/random.h"
#include "tests/shading/shading_fixture.h"

namespace relight::test {

Light directional_light(const glm::vec3& direction, const glm::vec3& irradiance) {
  Light light = omni_light({});
  light.name = "directional";
  light.type = LightType::directional;
  light.direction = glm::normalize(direction);
  light.intensity = irradiance;
  return light;
}

Light rectangle_light(const glm::vec3& centre, const glm::vec3& u, const glm::vec3& v,
                      const glm::vec3& radiance) {
  Light light = omni_light(centre);
  light.name = "rectangle";
  light.type = LightType::rectangle;
  light.edge_u = u, light.edge_v = v;
  light.direction = glm::normalize(glm::cross(u, v));
  light.intensity = radiance;
  return light;
}

Light disc_light(const glm::vec3& centre, const glm::vec3& direction, float radius,
                 const glm::vec3& radiance) {
  Light light = omni_light(centre);
  light.name = "disc";
  light.type = LightType::disc;
  light.direction = glm::normalize(direction);
  light.radius = radius;
  light.intensity = radiance;
  return light;
}

namespace {

std::shared_ptr<const Slide> random_slide() {
  Slide slide;
  slide.width = 4, slide.height = 3;
  slide.texels.clear();
  for (uint64_t i = 0; i < 12; ++i)
    slide.texels.emplace_back(0.2f + 0.8f * random_float(1, 1, i, 0), 0.2f + 0.8f * random_float(1, 1, i, 1),
                              0.2f + 0.8f * random_float(1, 1, i, 2), 1.0f);
  slide.content_hash = 12;
  return std::make_shared<const Slide>(slide);
}

}  // namespace

Light projector_light(const glm::vec3& position, const glm::vec3& direction) {
  Light light = omni_light(position);
  light.name = "projector";
  light.type = LightType::projector;
  light.direction = glm::normalize(direction);
  light.right = glm::normalize(glm::cross(light.direction, glm::vec3(0.1f, 1, 0)));
  light.beam.width = 0.5f, light.beam.height = 0.375f;
  light.slide = random_slide();
  return light;
}

Light uber_light(const glm::vec3& position, const glm::vec3& direction) {
  Light light = projector_light(position, direction);
  light.name = "uber";
  light.type = LightType::uber;
  light.beam = {0.5f, 0.4f, 0.15f, 0.1f, 0.6f, 0.1f, -0.05f, 0.6f, 0.3f, 1.8f, 0.8f, 1.5f, 1.2f};
  return light;
}

std::vector<Light> light_cases() {
  return {omni_light({0.2f, 1.5f, 0.1f}),
          spot_light({-1.5f, 1.5f, 1.5f}, glm::normalize(glm::vec3(1, -1.2f, -1)), 35.0f),
          directional_light({0.4f, -1.0f, -0.3f}),
          rectangle_light({0.1f, 1.9f, -0.2f}, {0.6f, 0, 0}, {0, 0, 0.4f}),
          disc_light({-1.6f, 1.0f, 0.2f}, {1, -0.5f, 0.1f}, 0.4f),
          projector_light({0.3f, 1.4f, 0.9f}, {0, -0.7f, -1}),
          uber_light({0.3f, 1.4f, 0.9f}, {0, -0.7f, -1})};
}

std::vector<float> rounding_scale_of(const std::vector<SurfaceSample>& samples,
                                     const std::vector<Emitter>& lights) {
  const auto largest = [](const glm::vec3& v) { return std::max({v.x, v.y, v.z}); };
  std::vector<float> scale(samples.size(), std::numeric_limits<float>::min());
  for (const Emitter& light : lights) {
    const bool spot = light.params.position_type.w == 1.0f;
    const float cone = light.params.intensity_inner.w - light.params.direction_outer.w;
    const float strength = largest(glm::vec3(light.params.intensity_inner)) * (spot ? 1.5f / cone : 1.0f);
    for (size_t i = 0; i < samples.size(); ++i) {
      const glm::vec3 d = light.position() - samples[i].position;
      const float peak = largest(samples[i].diffuse) + largest(samples[i].glossy) *
                                                           (samples[i].exponent + 2.0f) *
                                                           (1.0f + samples[i].exponent);
      const float r2 = light.is_directional() ? 1.0f : std::max(glm::dot(d, d), 1e-30f);
      scale[i] += peak * strength / r2;
    }
  }
  return scale;
}

}  // namespace relight::test
