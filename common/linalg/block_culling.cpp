#include "common/linalg/block_culling.h"

#include <glad/gl.h>

#include <cmath>

namespace relight {

float row_response(const glm::vec3& scale) { return std::sqrt(glm::dot(scale, scale) / 3.0f); }

BlockCulling::BlockCulling(const SparseRows& matrix, std::span<const glm::vec3> scale,
                           const ProductSettings& settings)
    : epsilon_(settings.cull_epsilon),
      columns_(matrix.columns),
      program_(gpu::Program::compute("common/linalg/cull_threshold.glsl")),
      threshold_(4),
      counters_(8) {
  std::vector<double> squares(matrix.columns, 0.0);
  for (size_t row = 0; row < matrix.rows(); ++row) {
    const auto response = static_cast<double>(row_response(scale[row]));
    for (const SparseEntry& e : matrix.row(row)) {
      const double v = response * static_cast<double>(e.value);
      squares[e.column] += v * v / settings.rows_share;
    }
  }
  norms_ = gpu::Buffer::from(std::vector<float>(squares.begin(), squares.end()));  // squared
}

void BlockCulling::begin(const gpu::Buffer& x) const {
  counters_.clear();
  if (epsilon_ > 0.0f) {
    norms_.bind_storage(0);
    x.bind_storage(1);
    threshold_.bind_storage(threshold_binding);
    program_.set("columns", columns_);
    program_.set("epsilon", epsilon_);
    program_.dispatch_items(256, 256);  // one workgroup
  } else {
    const float threshold = epsilon_ < 0.0f ? -1.0f : 0.0f;
    threshold_.upload(0, 4, &threshold);
  }
  threshold_.bind_storage(threshold_binding);
  counters_.bind_storage(counters_binding);
}

CullStatistics BlockCulling::count() const {
  // Vertex shaders count too; Buffer::download has the barrier for that.
  uint32_t counters[2];
  counters_.download(counters, sizeof(counters));
  return {counters[0], counters[1]};
}

}  // namespace relight
