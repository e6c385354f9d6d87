// Counter-based random numbers and low-discrepancy points: pure functions of their arguments, so that results
// do not depend on the number of threads or the order of work.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace relight {

// 64-bit finaliser (Stafford's variant 13 of the MurmurHash3 mixer); a bijection.
inline uint64_t mix64(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

inline uint64_t hash_combine(uint64_t a, uint64_t b) { return mix64(a + 0x9e3779b97f4a7c15ull * (b + 1)); }

// Random bits as a function of (seed, stream, index, dimension), for many dimensions of one index.
class RandomDimensions {
 public:
  RandomDimensions(uint64_t seed, uint64_t stream, uint64_t index)
      : index_(hash_combine(hash_combine(mix64(seed + 0x632be59bd9b4e019ull), stream), index)) {}
  uint64_t bits(uint64_t dimension) const { return hash_combine(index_, dimension); }

 private:
  uint64_t index_;
};

inline uint64_t random_bits(uint64_t seed, uint64_t stream, uint64_t index, uint64_t dimension) {
  return RandomDimensions(seed, stream, index).bits(dimension);
}

// In [0,1): 24 bits, so that the float can never round up to 1.
inline float to_unit_float(uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

inline float random_float(uint64_t seed, uint64_t stream, uint64_t index, uint64_t dimension) {
  return to_unit_float(random_bits(seed, stream, index, dimension));
}

// Point `index` of an Owen-scrambled Sobol (0,2)-sequence in [0,1)^2, with its order shuffled; `scramble`
// selects the scrambling and the shuffle, so use a different one for every pair of dimensions, pixel and
// batch (Burley, "Practical Hash-based Owen Scrambling", JCGT 2020).
glm::vec2 sobol_2d(uint32_t index, uint64_t scramble);

}  // namespace relight
