// The Haar transform of haar.h for a vector of which few values are not zero.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace relight::wavelet {

// One value of a sparse RGB vector, or one of its coefficients.
struct SparseValue {
  uint32_t index;
  glm::vec3 value;
};

// Transforms `values` (indices ascending and below n, none twice), taken as a vector of n values in tree
// order (n a power of four, else Error). Fills `coefficients` with those that are not zero in any channel, in
// no particular order. `values` is used up. Cost: proportional to values.size() x log4(n), never to n.
void forward_sparse(std::vector<SparseValue>& values, uint32_t n, std::vector<SparseValue>& coefficients);

}  // namespace relight::wavelet
