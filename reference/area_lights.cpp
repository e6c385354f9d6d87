#include "reference/area_lights.h"

#include <algorithm>
#include <cmath>

#include "common/image/luminance.h"

namespace relight {

AreaLights::AreaLights(const Scene& scene, const LightingState& lighting, bool triangles, float lift)
    : scene_(scene) {
  if (triangles) add_triangles();
  add_shapes(lighting, lift);
  for (Shape& shape : shapes_)
    shape.area_pdf = static_cast<float>(luminance(glm::dvec3(shape.radiance)) / power_);
  for (float& pdf : triangle_pdf_) pdf = static_cast<float>(static_cast<double>(pdf) / power_);
}

// Power is luminance x area x sides; the density on a triangle is then luminance x sides / total power.
void AreaLights::add_triangles() {
  const auto shines = [](const Material& m) { return luminance(glm::dvec3(m.emission)) > 0.0; };
  if (std::none_of(scene_.materials.begin(), scene_.materials.end(), shines)) return;
  triangle_pdf_.assign(scene_.triangles.size(), 0.0f);
  for (size_t t = 0; t < scene_.triangles.size(); ++t) {
    const double strength =
        2.0 * luminance(glm::dvec3(scene_.materials[scene_.triangles[t].material].emission));
    const double area = 0.5 * glm::length(glm::dvec3(scene_.area_normal(t)));
    if (!(strength * area > 0.0)) continue;
    power_ += strength * area;
    triangle_pdf_[t] = static_cast<float>(strength);
    sources_.push_back({power_, static_cast<uint32_t>(t), false});
  }
}

void AreaLights::add_shapes(const LightingState& lighting, float lift) {
  for (const Light& light : lighting.lights) {
    if (!has_area(light.type) || !(luminance(glm::dvec3(light.intensity)) > 0.0)) continue;
    const Shape shape{AreaShape(light, lift), light.intensity};
    power_ += luminance(glm::dvec3(light.intensity)) * static_cast<double>(shape.form.area);
    sources_.push_back({power_, static_cast<uint32_t>(shapes_.size()), true});
    shapes_.push_back(shape);
  }
}

AreaPoint AreaLights::sample(float u_choice, const glm::vec2& u) const {
  AreaPoint point;
  if (sources_.empty()) return point;
  const double target = static_cast<double>(u_choice) * power_;
  const auto found = std::upper_bound(sources_.begin(), sources_.end() - 1, target,
                                      [](double x, const Source& s) { return x < s.cumulative; });
  if (found->is_shape) {
    const Shape& shape = shapes_[found->index];
    return {shape.form.point(u), shape.form.normal, shape.radiance, shape.area_pdf, false};
  }
  const Triangle& triangle = scene_.triangles[found->index];
  const float root = std::sqrt(u.x), b = root * (1.0f - u.y), c = root * u.y;
  const glm::vec3 p0 = scene_.positions[triangle.v[0]], p1 = scene_.positions[triangle.v[1]],
                  p2 = scene_.positions[triangle.v[2]];
  const glm::dvec3 n = glm::dvec3(scene_.area_normal(found->index));
  return {(1.0f - b - c) * p0 + b * p1 + c * p2, glm::vec3(n / glm::length(n)),
          scene_.materials[triangle.material].emission, triangle_pdf_[found->index], true};
}

AreaPoint AreaLights::shape_point(size_t i, const glm::vec2& u) const {
  const Shape& shape = shapes_[i];
  return {shape.form.point(u), shape.form.normal, shape.radiance, 1.0f / shape.form.area, false};
}

bool AreaLights::meets(size_t index, const glm::vec3& origin, const glm::vec3& direction, float t_far,
                       ShapeHit& hit) const {
  const Shape& shape = shapes_[index];
  const AreaShape& form = shape.form;
  const float cosine = -glm::dot(form.normal, direction);
  if (!(cosine > 0.0f)) return false;
  const float t = glm::dot(form.normal, origin - form.centre) / cosine;
  if (!(t > 0.0f && t < t_far)) return false;
  const glm::vec3 at = origin + t * direction - form.centre;
  const float x = glm::dot(at, form.u) / glm::dot(form.u, form.u),
              y = glm::dot(at, form.v) / glm::dot(form.v, form.v);
  const bool inside = form.is_disc ? x * x + y * y <= 1.0f : std::abs(x) <= 1.0f && std::abs(y) <= 1.0f;
  if (inside) hit = {shape.radiance, t, cosine, shape.area_pdf};
  return inside;
}

}  // namespace relight
