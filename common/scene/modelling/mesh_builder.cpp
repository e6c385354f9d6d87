#include "common/scene/modelling/mesh_builder.h"

#include <array>
#include <cmath>

namespace relight::modelling {

Frame turned(const glm::dvec3& origin, double degrees) {
  const double a = glm::radians(degrees);
  const glm::dvec3 x(std::cos(a), 0.0, -std::sin(a)), z(std::sin(a), 0.0, std::cos(a));
  return {origin, glm::dmat3(x, glm::dvec3(0, 1, 0), z)};
}

Frame standing_along(const glm::dvec3& origin, const glm::dvec3& up) {
  const glm::dvec3 y = glm::normalize(up);
  const glm::dvec3 helper = std::abs(y.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 z = glm::normalize(glm::cross(helper, y));
  return {origin, glm::dmat3(glm::cross(y, z), y, z)};
}

uint32_t MeshBuilder::material(const std::string& name, const glm::vec3& diffuse, const glm::vec3& glossy,
                               float exponent) {
  Material m;
  m.name = name;
  m.diffuse = diffuse;
  m.glossy = glossy;
  m.exponent = exponent;
  scene_.materials.push_back(m);
  return static_cast<uint32_t>(scene_.materials.size() - 1);
}

uint32_t MeshBuilder::add_texture(Texture texture) {
  scene_.textures.push_back(std::move(texture));
  return static_cast<uint32_t>(scene_.textures.size() - 1);
}

void MeshBuilder::object(const std::string& name, uint32_t material) {
  scene_.object_names.push_back(name);
  object_ = static_cast<uint32_t>(scene_.object_names.size() - 1);
  material_ = material;
}

uint32_t MeshBuilder::vertex(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec2& uv) {
  scene_.positions.emplace_back(position);
  scene_.normals.emplace_back(glm::normalize(normal));
  scene_.uvs.emplace_back(uv);
  return static_cast<uint32_t>(scene_.positions.size() - 1);
}

void MeshBuilder::triangle(uint32_t a, uint32_t b, uint32_t c) {
  const auto& p = scene_.positions;
  if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
  scene_.triangles.push_back({{a, b, c}, material_, object_});
}

void MeshBuilder::quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void MeshBuilder::face(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
                       int nu, int nv) {
  const glm::dvec3 normal = glm::cross(c - a, d - b);
  const double width = glm::length(b - a), height = glm::length(d - a);
  const auto first = static_cast<uint32_t>(scene_.positions.size());
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) {
      const double s = double(i) / nu, t = double(j) / nv;
      // Written symmetrically: a face that shares an edge the other way round gets the same positions.
      const glm::dvec3 p = (1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d;
      vertex(p, normal, {s * width, t * height});
    }
  const auto at = [&](int i, int j) { return first + static_cast<uint32_t>(j * (nu + 1) + i); };
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
}

void MeshBuilder::box(const Frame& frame, const glm::dvec3& lo, const glm::dvec3& hi, int cuts) {
  std::array<glm::dvec3, 8> p;
  for (size_t i = 0; i < 8; ++i)
    p[i] = frame.point({(i & 1) ? hi.x : lo.x, (i & 2) ? hi.y : lo.y, (i & 4) ? hi.z : lo.z});
  constexpr size_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& f : faces) face(p[f[0]], p[f[1]], p[f[2]], p[f[3]], cuts, cuts);
}

}  // namespace relight::modelling
