#include "experiments/effects/scene_facts.h"

#include <algorithm>
#include <cmath>

namespace relight {

namespace {

bool shows_gloss(const SurfaceSample& s) { return s.valid && s.glossy != glm::vec3(0.0f); }

double glossy_pixel_share(const DeepFrameBuffer& buffer) {
  const auto width = static_cast<size_t>(buffer.view.width);
  size_t glossy = 0;
  for (size_t i = 0; i < buffer.indirect.size(); ++i) {
    const size_t x = i % width, y = i / width;
    bool shows = shows_gloss(buffer.indirect[i]);
    for (size_t sub = 0; sub < 4 && !shows; ++sub)
      shows = shows_gloss(buffer.direct[(2 * y + sub / 2) * 2 * width + 2 * x + sub % 2]);
    glossy += shows;
  }
  return static_cast<double>(glossy) / static_cast<double>(buffer.indirect.size());
}

// Farther from the plane than rounding of coordinates explains: not flat.
constexpr double flatness = 1e-6;

bool lies_in_one_plane(const Scene& scene) {
  size_t largest = 0;
  double area = 0.0;
  for (size_t t = 0; t < scene.triangles.size(); ++t)
    if (const double a = static_cast<double>(glm::length(scene.area_normal(t))); a > area)
      largest = t, area = a;
  if (!(area > 0.0)) return true;
  const glm::dvec3 n = glm::normalize(glm::dvec3(scene.area_normal(largest)));
  const glm::dvec3 origin(scene.positions[scene.triangles[largest].v[0]]);
  const double most = flatness * static_cast<double>(scene.bounds.diagonal());
  for (const Triangle& t : scene.triangles)
    for (const uint32_t v : t.v)
      if (std::abs(glm::dot(n, glm::dvec3(scene.positions[v]) - origin)) > most) return false;
  return true;
}

}  // namespace

SceneFacts scene_facts(const EffectSite& site) {
  SceneFacts facts;
  const auto& materials = site.scene.materials;
  facts.glossy_material =
      std::any_of(materials.begin(), materials.end(), [](const Material& m) { return m.is_glossy(); });
  if (facts.glossy_material) facts.glossy_pixels = glossy_pixel_share(site.buffer);
  facts.environment = !site.lighting.environment_or(site.scene.environment).black();
  facts.emission = std::any_of(materials.begin(), materials.end(),
                               [](const Material& m) { return m.emission != glm::vec3(0.0f); });
  for (const Light& light : site.lighting.lights)
    if (light.intensity != glm::vec3(0.0f))
      (has_area(light.type) ? facts.area_lights : facts.local_lights) = true;
  facts.one_plane = lies_in_one_plane(site.scene);
  return facts;
}

std::string why_impossible(const PathClass& c, const SceneFacts& facts) {
  if (c.end == LightEnd::local && !facts.local_lights) return "no omni, spot or directional light shines";
  if (c.end == LightEnd::area && !facts.emission && (c.bounces < 0 || !facts.area_lights))
    return "no surface emits light and no light has an area";
  if (c.end == LightEnd::environment && !facts.environment) return "the environment is black";
  if (c.bounces > 0 && facts.one_plane) return "all surfaces lie in one plane, so none sees another";
  if ((c.glossy_at_eye || c.glossy_interior) && !facts.glossy_material) return "no material is glossy";
  if (c.glossy_at_eye && facts.glossy_pixels == 0.0) return "no visible surface is glossy";
  return "";
}

}  // namespace relight
