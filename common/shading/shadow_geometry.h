// The scene's triangles on the GPU, uploaded once, cut into chunks with bounds for culling.
#pragma once

#include <cstdint>
#include <vector>

#include "common/gpu/buffer.h"
#include "common/scene/scene.h"
#include "common/shading/light_frame.h"

namespace relight {

class ShadowGeometry {
 public:
  explicit ShadowGeometry(const Scene& scene);
  // Draws the chunks that may be inside the face. Expects program and framebuffer to be bound; vertex
  // attribute 0 is the position.
  void draw(const LightFrame& frame, const ShadowFace& face) const;
  const Bounds& bounds() const { return bounds_; }
  // Distance from p to the farthest corner of the scene's bounds.
  float reach(const glm::vec3& p) const;
  bool empty() const { return chunks_.empty(); }
  int64_t bytes() const { return positions_.bytes() + indices_.bytes(); }

 private:
  // Consecutive triangles of one object, in the order of the index buffer.
  struct Chunk {
    Bounds bounds;
    int64_t first = 0, count = 0;  // triangles
  };
  void cut_into_chunks(const Scene& scene, const std::vector<uint32_t>& order);

  std::vector<Chunk> chunks_;
  Bounds bounds_;
  gpu::Buffer positions_, indices_;
  gpu::Object vertex_array_;
};

}  // namespace relight
