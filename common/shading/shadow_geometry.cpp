#include "common/shading/shadow_geometry.h"

#include <glad/gl.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relight {
namespace {

// Small enough that a chunk of a large object can be culled, large enough that draws stay few.
constexpr int64_t chunk_triangles = 1024;

double distance_to_box(const Bounds& box, const glm::vec3& p) {
  const glm::dvec3 outside = glm::max(
      glm::max(glm::dvec3(box.lo) - glm::dvec3(p), glm::dvec3(p) - glm::dvec3(box.hi)), glm::dvec3(0.0));
  return glm::length(outside);
}

double squared_distance_to_segment(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0.0 ? glm::clamp(-glm::dot(a, ab) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 q = a + ab * t;
  return glm::dot(q, q);
}

// From the origin: to the plane if the foot of the perpendicular lies inside, else to the nearest edge.
double squared_distance_to_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const bool inside = glm::dot(glm::cross(b - a, -a), n) >= 0.0 &&
                      glm::dot(glm::cross(c - b, -b), n) >= 0.0 && glm::dot(glm::cross(a - c, -c), n) >= 0.0;
  const double n2 = glm::dot(n, n);
  if (inside && n2 > 0.0) return glm::dot(a, n) * glm::dot(a, n) / n2;
  return std::min({squared_distance_to_segment(a, b), squared_distance_to_segment(b, c),
                   squared_distance_to_segment(c, a)});
}

// True if the whole box lies on the far side of the plane through `origin` with inward normal n.
bool box_is_outside(const Bounds& box, const glm::vec3& origin, const glm::vec3& n) {
  const glm::vec3 farthest = glm::mix(box.lo, box.hi, glm::greaterThan(n, glm::vec3(0.0f)));
  return glm::dot(farthest - origin, n) < 0.0f;
}

bool may_be_visible(const Bounds& box, const LightFrame& frame, const ShadowFace& face) {
  const glm::vec3 inward = face.forward * frame.tan_half;
  for (const glm::vec3& n :
       {face.forward, inward + face.right, inward - face.right, inward + face.up, inward - face.up}) {
    if (box_is_outside(box, frame.position, n)) return false;
  }
  return true;
}

}  // namespace

ShadowGeometry::ShadowGeometry(const Scene& scene) : scene_(scene), order_(scene.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::stable_sort(order_.begin(), order_.end(), [&scene](uint32_t a, uint32_t b) {
    return scene.triangles[a].object < scene.triangles[b].object;
  });
  cut_into_chunks(order_);
  std::vector<uint32_t> indices;
  indices.reserve(order_.size() * 3);
  for (const uint32_t t : order_) {
    for (const uint32_t v : scene.triangles[t].v) indices.push_back(v);
  }
  positions_ = gpu::Buffer::from(scene.positions);
  indices_ = gpu::Buffer::from(indices);
  vertex_array_ = gpu::create_object(gpu::ObjectKind::vertex_array);
  const GLuint array = vertex_array_.id();
  glVertexArrayVertexBuffer(array, 0, positions_.id(), 0, sizeof(glm::vec3));
  glVertexArrayElementBuffer(array, indices_.id());
  glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(array, 0, 0);
  glEnableVertexArrayAttrib(array, 0);
}

void ShadowGeometry::cut_into_chunks(const std::vector<uint32_t>& order) {
  for (size_t i = 0; i < order.size(); ++i) {
    const Triangle& triangle = scene_.triangles[order[i]];
    const bool new_object = i == 0 || scene_.triangles[order[i - 1]].object != triangle.object;
    if (new_object || chunks_.back().count == chunk_triangles) {
      chunks_.emplace_back();
      chunks_.back().first = static_cast<int64_t>(i);
    }
    ++chunks_.back().count;
    for (const uint32_t v : triangle.v) {
      chunks_.back().bounds.add(scene_.positions[v]);
      bounds_.add(scene_.positions[v]);
    }
  }
}

void ShadowGeometry::draw(const LightFrame& frame, const ShadowFace& face) const {
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;
  int64_t end_of_last = -1;
  for (const Chunk& chunk : chunks_) {
    if (!may_be_visible(chunk.bounds, frame, face)) continue;
    if (chunk.first == end_of_last) {
      counts.back() += static_cast<GLsizei>(chunk.count * 3);
    } else {
      counts.push_back(static_cast<GLsizei>(chunk.count * 3));
      offsets.push_back(
          reinterpret_cast<const void*>(static_cast<uintptr_t>(chunk.first) * 3 * sizeof(uint32_t)));
    }
    end_of_last = chunk.first + chunk.count;
  }
  if (counts.empty()) return;
  glBindVertexArray(vertex_array_.id());
  glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                      static_cast<GLsizei>(counts.size()));
  glBindVertexArray(0);
}

float ShadowGeometry::clearance(const glm::vec3& p) const {
  // Chunks by the distance of their boxes: most scenes need a handful.
  std::vector<std::pair<double, size_t>> by_distance;
  for (size_t i = 0; i < chunks_.size(); ++i)
    by_distance.emplace_back(distance_to_box(chunks_[i].bounds, p), i);
  std::sort(by_distance.begin(), by_distance.end());
  double best = INFINITY;
  for (const auto& [distance, i] : by_distance) {
    if (distance * distance >= best) break;
    for (int64_t k = chunks_[i].first; k < chunks_[i].first + chunks_[i].count; ++k) {
      const Triangle& t = scene_.triangles[order_[static_cast<size_t>(k)]];
      const auto corner = [&](int c) { return glm::dvec3(scene_.positions[t.v[c]]) - glm::dvec3(p); };
      best = std::min(best, squared_distance_to_triangle(corner(0), corner(1), corner(2)));
    }
  }
  return std::isfinite(best) ? static_cast<float>(std::sqrt(best)) : 0.0f;
}

float ShadowGeometry::reach(const glm::vec3& p) const {
  if (empty()) return 0.0f;
  return glm::length(glm::max(glm::abs(bounds_.lo - p), glm::abs(bounds_.hi - p)));
}

}  // namespace relight
