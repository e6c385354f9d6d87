#include "reference/area_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/brdf/brdf.h"
#include "common/image/luminance.h"

namespace relight {
namespace {

// Uniform on the unit disc, without seam at the centre (Shirley and Chiu, "A Low Distortion Map Between Disk
// and Square", JGT 1997).
glm::vec2 to_disc(const glm::vec2& u) {
  const float x = 2.0f * u.x - 1.0f, y = 2.0f * u.y - 1.0f;
  if (x == 0.0f && y == 0.0f) return {0.0f, 0.0f};
  constexpr float quarter_pi = 0.25f * std::numbers::pi_v<float>;
  const bool wide = std::abs(x) > std::abs(y);
  const float r = wide ? x : y;
  const float phi = wide ? quarter_pi * (y / x) : 2.0f * quarter_pi - quarter_pi * (x / y);
  return {r * std::cos(phi), r * std::sin(phi)};
}

}  // namespace

AreaLights::AreaLights(const Scene& scene, const LightingState& lighting, bool triangles, float lift)
    : scene_(scene) {
  if (triangles) add_triangles();
  add_shapes(lighting, lift);
  for (Shape& shape : shapes_)
    shape.area_pdf = static_cast<float>(luminance(glm::dvec3(shape.light.intensity)) / power_);
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
    if (is_delta(light.type) || !(luminance(glm::dvec3(light.intensity)) > 0.0)) continue;
    Shape shape{light, light.edge_u, light.edge_v, 0.0f};
    shape.light.direction = glm::normalize(light.direction);
    shape.light.position += lift * shape.light.direction;
    if (light.type == LightType::disc) {
      const glm::mat3 frame = frame_around(shape.light.direction);
      shape.u = light.radius * frame[0], shape.v = light.radius * frame[1];
    }
    const float parallelogram = glm::length(glm::cross(shape.u, shape.v));
    shape.area = parallelogram * (light.type == LightType::disc ? std::numbers::pi_v<float> : 4.0f);
    power_ += luminance(glm::dvec3(light.intensity)) * static_cast<double>(shape.area);
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
    const glm::vec2 at = shape.light.type == LightType::disc ? to_disc(u) : 2.0f * u - glm::vec2(1.0f);
    return {shape.light.position + at.x * shape.u + at.y * shape.v, shape.light.direction,
            shape.light.intensity, shape.area_pdf, false};
  }
  const Triangle& triangle = scene_.triangles[found->index];
  const float root = std::sqrt(u.x), b = root * (1.0f - u.y), c = root * u.y;
  const glm::vec3 p0 = scene_.positions[triangle.v[0]], p1 = scene_.positions[triangle.v[1]],
                  p2 = scene_.positions[triangle.v[2]];
  const glm::dvec3 n = glm::dvec3(scene_.area_normal(found->index));
  return {(1.0f - b - c) * p0 + b * p1 + c * p2, glm::vec3(n / glm::length(n)),
          scene_.materials[triangle.material].emission, triangle_pdf_[found->index], true};
}

bool AreaLights::meets(size_t index, const glm::vec3& origin, const glm::vec3& direction, float t_far,
                       ShapeHit& hit) const {
  const Shape& shape = shapes_[index];
  const float cosine = -glm::dot(shape.light.direction, direction);
  if (!(cosine > 0.0f)) return false;
  const float t = glm::dot(shape.light.direction, origin - shape.light.position) / cosine;
  if (!(t > 0.0f && t < t_far)) return false;
  const glm::vec3 at = origin + t * direction - shape.light.position;
  const float x = glm::dot(at, shape.u) / glm::dot(shape.u, shape.u),
              y = glm::dot(at, shape.v) / glm::dot(shape.v, shape.v);
  const bool inside = shape.light.type == LightType::disc ? x * x + y * y <= 1.0f
                                                          : std::abs(x) <= 1.0f && std::abs(y) <= 1.0f;
  if (inside) hit = {shape.light.intensity, t, cosine, shape.area_pdf};
  return inside;
}

}  // namespace relight
