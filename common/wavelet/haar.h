// Orthonormal 2-D Haar transform of 4^n values (non-standard decomposition, Stollnitz et al. 1995; GPU Gems 3
// chapter 9, listing 9-4), in tree order.
//
// Tree order: the 2^n x 2^n array is stored along the Morton (Z) curve, so that every aligned block of 4^k
// values is contiguous; the gather hierarchy's leaves have this order by construction. Coefficients use the
// same curve over the usual pyramid layout: index 0 is the scaling coefficient; the three details t = 1, 2, 3
// (horizontal, vertical, diagonal) of node i on the level with m = 4^j nodes have index t m + i. A node's
// children c0..c3 are its upper left, upper right, lower left, lower right quarters.
#pragma once

#include <cstdint>
#include <vector>

namespace relight::wavelet {

// True for 1, 4, 16, ...
bool is_power_of_four(int64_t n);

// Largest power of four <= index (index >= 1): the number of nodes on the level of coefficient `index`.
uint32_t level_nodes(uint32_t index);

// Number of non-zeros ("area") of basis function `index` of a transform of n values.
inline uint32_t support(uint32_t index, uint32_t n) { return index == 0 ? n : n / level_nodes(index); }

// One analysis step on four children: returns the scaling coefficient, fills the three details.
template <typename T>
T haar_step(const T& c0, const T& c1, const T& c2, const T& c3, T* details) {
  const T half = T(0.5);
  details[0] = half * ((c0 - c1) + (c2 - c3));  // horizontal
  details[1] = half * ((c0 + c1) - (c2 + c3));  // vertical
  details[2] = half * ((c0 - c1) - (c2 - c3));  // diagonal
  return half * ((c0 + c1) + (c2 + c3));
}

// Forward and inverse transform of values in tree order; size a power of four, else Error. T: float, double,
// glm::vec3.
template <typename T>
std::vector<T> forward(const std::vector<T>& values);
template <typename T>
std::vector<T> inverse(const std::vector<T>& coefficients);

}  // namespace relight::wavelet
