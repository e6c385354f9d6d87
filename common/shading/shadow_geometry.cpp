#include "common/shading/shadow_geometry.h"

#include <glad/gl.h>

#include <algorithm>
#include <numeric>

namespace relight {
namespace {

// Small enough that a chunk of a large object can be culled, large enough that draws stay few.
constexpr int64_t chunk_triangles = 1024;

// True if the whole box lies on the far side of the plane through `origin` with inward normal n.
bool box_is_outside(const Bounds& box, const glm::vec3& origin, const glm::vec3& n) {
  const glm::vec3 farthest = glm::mix(box.lo, box.hi, glm::greaterThan(n, glm::vec3(0.0f)));
  return glm::dot(farthest - origin, n) < 0.0f;
}

bool may_be_visible(const Bounds& box, const LightFrame& frame, const ShadowFace& face) {
  if (frame.parallel) return true;  // the map holds the whole scene
  const glm::vec3 inward = face.forward * frame.tan_half;
  for (const glm::vec3& n :
       {face.forward, inward + face.right, inward - face.right, inward + face.up, inward - face.up}) {
    if (box_is_outside(box, frame.position, n)) return false;
  }
  return true;
}

}  // namespace

ShadowGeometry::ShadowGeometry(const Scene& scene) {
  std::vector<uint32_t> order(scene.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&scene](uint32_t a, uint32_t b) {
    return scene.triangles[a].object < scene.triangles[b].object;
  });
  cut_into_chunks(scene, order);
  std::vector<uint32_t> indices;
  indices.reserve(order.size() * 3);
  for (const uint32_t t : order) {
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

void ShadowGeometry::cut_into_chunks(const Scene& scene, const std::vector<uint32_t>& order) {
  for (size_t i = 0; i < order.size(); ++i) {
    const Triangle& triangle = scene.triangles[order[i]];
    const bool new_object = i == 0 || scene.triangles[order[i - 1]].object != triangle.object;
    if (new_object || chunks_.back().count == chunk_triangles) {
      chunks_.emplace_back();
      chunks_.back().first = static_cast<int64_t>(i);
    }
    ++chunks_.back().count;
    for (const uint32_t v : triangle.v) {
      chunks_.back().bounds.add(scene.positions[v]);
      bounds_.add(scene.positions[v]);
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

float ShadowGeometry::reach(const glm::vec3& p) const {
  if (empty()) return 0.0f;
  return glm::length(glm::max(glm::abs(bounds_.lo - p), glm::abs(bounds_.hi - p)));
}

}  // namespace relight
