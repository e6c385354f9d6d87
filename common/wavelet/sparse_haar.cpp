#include "common/wavelet/sparse_haar.h"

#include "common/run/error.h"
#include "common/wavelet/haar.h"

namespace relight::wavelet {
namespace {

void append_unless_zero(std::vector<SparseValue>& out, uint32_t index, const glm::vec3& value) {
  if (value != glm::vec3(0.0f)) out.push_back({index, value});
}

}  // namespace

void forward_sparse(std::vector<SparseValue>& values, uint32_t n, std::vector<SparseValue>& coefficients) {
  if (!is_power_of_four(n)) fail("sparse Haar transform: {} values, expected a power of four", n);
  coefficients.clear();
  for (uint32_t nodes = n / 4; nodes >= 1; nodes /= 4) {
    size_t parents = 0;  // written in place: a parent needs at least one child, so it never overtakes them
    for (size_t first = 0; first < values.size();) {
      const uint32_t node = values[first].index / 4;
      glm::vec3 child[4]{}, details[3];
      for (; first < values.size() && values[first].index / 4 == node; ++first)
        child[values[first].index % 4] = values[first].value;
      const glm::vec3 scaling = haar_step(child[0], child[1], child[2], child[3], details);
      for (uint32_t t = 0; t < 3; ++t) append_unless_zero(coefficients, (t + 1) * nodes + node, details[t]);
      values[parents++] = {node, scaling};
    }
    values.resize(parents);
  }
  for (const SparseValue& root : values) append_unless_zero(coefficients, 0, root.value);
}

}  // namespace relight::wavelet
