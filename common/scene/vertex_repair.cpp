// Repair of what lives on vertices: normals, and vertices that are unused or equal.
#include <algorithm>
#include <bit>
#include <cmath>

#include "common/sampling/random.h"
#include "common/scene/topology.h"
#include "common/scene/validation.h"

namespace relight {

namespace {

bool usable(const glm::vec3& n) {
  const float length2 = glm::dot(n, n);
  return std::isfinite(length2) && length2 > 0.0f;
}

// For each vertex (after welding) the triangles around it.
struct Fans {
  std::vector<uint32_t> first, triangles;  // triangles of vertex v: triangles[first[v] .. first[v + 1])
};

Fans find_fans(const std::vector<uint32_t>& welded, const std::vector<Triangle>& triangles) {
  Fans fans;
  fans.first.assign(welded.size() + 1, 0);
  for (const Triangle& t : triangles)
    for (uint32_t v : t.v) ++fans.first[welded[v] + 1];
  for (size_t v = 0; v < welded.size(); ++v) fans.first[v + 1] += fans.first[v];
  fans.triangles.resize(fans.first.back());
  std::vector<uint32_t> next(fans.first.begin(), fans.first.end() - 1);
  for (uint32_t t = 0; t < triangles.size(); ++t)
    for (uint32_t v : triangles[t].v) fans.triangles[next[welded[v]]++] = t;
  return fans;
}

double corner_angle(const Scene& scene, const Triangle& t, int corner) {
  const glm::dvec3 p(scene.positions[t.v[corner]]);
  const glm::dvec3 a = glm::dvec3(scene.positions[t.v[(corner + 1) % 3]]) - p;
  const glm::dvec3 b = glm::dvec3(scene.positions[t.v[(corner + 2) % 3]]) - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

class NormalMaker {
 public:
  NormalMaker(const Scene& scene, float crease_degrees)
      : scene_(scene),
        welded_(weld_positions(scene.positions)),
        fans_(find_fans(welded_, scene.triangles)),
        cos_crease_(std::cos(glm::radians(double(crease_degrees)))) {
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
      const Triangle& triangle = scene.triangles[t];
      const glm::dvec3 a(scene.positions[triangle.v[0]]);
      faces_.push_back(glm::normalize(glm::cross(glm::dvec3(scene.positions[triangle.v[1]]) - a,
                                                 glm::dvec3(scene.positions[triangle.v[2]]) - a)));
    }
  }

  glm::vec3 normal(size_t triangle, int corner) const {
    const uint32_t vertex = welded_[scene_.triangles[triangle].v[corner]];
    glm::dvec3 sum(0.0);
    for (uint32_t i = fans_.first[vertex]; i < fans_.first[vertex + 1]; ++i) {
      const uint32_t other = fans_.triangles[i];
      if (other != triangle && glm::dot(faces_[other], faces_[triangle]) < cos_crease_) continue;
      const Triangle& t = scene_.triangles[other];
      for (int k = 0; k < 3; ++k)
        if (welded_[t.v[k]] == vertex) sum += corner_angle(scene_, t, k) * faces_[other];
    }
    const double length = glm::length(sum);
    return glm::vec3(length > 0.0 ? sum / length : faces_[triangle]);
  }

 private:
  const Scene& scene_;
  std::vector<uint32_t> welded_;
  Fans fans_;
  double cos_crease_;
  std::vector<glm::dvec3> faces_;
};

void make_missing_normals(Scene& scene, float crease_degrees) {
  const NormalMaker maker(scene, crease_degrees);
  std::vector<Triangle> triangles = scene.triangles;
  const auto shared_vertices = scene.positions.size();
  for (size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const uint32_t v = scene.triangles[t].v[k];
      if (usable(scene.normals[v])) continue;
      // A vertex of its own for each corner; compact_vertices joins those that came out equal.
      triangles[t].v[k] = static_cast<uint32_t>(scene.normals.size());
      scene.normals.push_back(maker.normal(t, k));
      scene.uvs.push_back(scene.uvs[v]);
    }
  for (size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (triangles[t].v[k] >= shared_vertices)
        scene.positions.push_back(scene.positions[scene.triangles[t].v[k]]);
  scene.triangles = std::move(triangles);
}

}  // namespace

void repair_normals(Scene& scene, float crease_degrees) {
  // Vertices of removed triangles don't count: their normals are of no use.
  std::vector<bool> used(scene.positions.size(), false);
  for (const Triangle& t : scene.triangles)
    for (uint32_t v : t.v) used[v] = true;
  int64_t missing = 0, rescaled = 0;
  for (size_t v = 0; v < scene.normals.size(); ++v) {
    if (!used[v]) continue;
    glm::vec3& n = scene.normals[v];
    if (!usable(n)) {
      ++missing;
      continue;
    }
    // Text files hold a few digits: that much is not worth a count.
    const double length = glm::length(glm::dvec3(n));
    rescaled += std::abs(length - 1.0) > 1e-3;
    n = glm::vec3(glm::dvec3(n) / length);
  }
  if (missing > 0) {
    make_missing_normals(scene, crease_degrees);
    scene.repairs.counts["vertices_given_a_computed_normal"] += missing;
  }
  if (rescaled > 0) scene.repairs.counts["normals_brought_to_unit_length"] += rescaled;
}

void compact_vertices(Scene& scene) {
  constexpr uint32_t empty = UINT32_MAX;
  const size_t slots = std::bit_ceil(2 * scene.positions.size() + 1);
  std::vector<uint32_t> table(slots, empty), new_index(scene.positions.size(), empty);
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;
  const auto bits = [](float a, float b) {
    return static_cast<uint64_t>(std::bit_cast<uint32_t>(a + 0.0f)) |
           static_cast<uint64_t>(std::bit_cast<uint32_t>(b + 0.0f)) << 32;
  };
  const auto place = [&](uint32_t v) {
    const glm::vec3 p = scene.positions[v], n = scene.normals[v];
    const glm::vec2 uv = scene.uvs[v];
    const uint64_t key = hash_combine(hash_combine(bits(p.x, p.y), bits(p.z, n.x)),
                                      hash_combine(bits(n.y, n.z), bits(uv.x, uv.y)));
    size_t slot = key & (slots - 1);
    for (; table[slot] != empty; slot = (slot + 1) & (slots - 1)) {
      const uint32_t known = table[slot];
      if (positions[known] == p && normals[known] == n && uvs[known] == uv) return known;
    }
    table[slot] = static_cast<uint32_t>(positions.size());
    positions.push_back(p);
    normals.push_back(n);
    uvs.push_back(uv);
    return table[slot];
  };
  for (Triangle& t : scene.triangles)
    for (uint32_t& v : t.v) {
      if (new_index[v] == empty) new_index[v] = place(v);
      v = new_index[v];
    }
  scene.positions = std::move(positions);
  scene.normals = std::move(normals);
  scene.uvs = std::move(uvs);
}

}  // namespace relight
