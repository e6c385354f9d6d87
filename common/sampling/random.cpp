// Owen-scrambled Sobol points by hashing.
// This work is based on: Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; its permutation is
// Laine and Karras's ("Stratified Sampling for Stochastic Transparency", 2011) with Burley's constants.
#include "common/sampling/random.h"

namespace relight {

namespace {

uint32_t reverse_bits(uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

// Each bit of the result depends on the bits below it only: applied to reversed bits, a nested uniform
// scrambling.
uint32_t permute_upwards(uint32_t x, uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

// Product with the generator matrix of Sobol's second dimension, least significant bit first. The matrix is
// Pascal's triangle mod 2, and C(k, j) is odd iff the bits of j are among those of k, so it is a sum over
// supersets, one bit of the position at a time: 5 steps instead of 32.
uint32_t pascal_product(uint32_t x) {
  x ^= (x >> 1) & 0x55555555u;
  x ^= (x >> 2) & 0x33333333u;
  x ^= (x >> 4) & 0x0f0f0f0fu;
  x ^= (x >> 8) & 0x00ff00ffu;
  x ^= (x >> 16) & 0x0000ffffu;
  return x;
}

float unit(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace

glm::vec2 sobol_2d(uint32_t index, uint64_t scramble) {
  const uint64_t a = mix64(scramble + 0x9e3779b97f4a7c15ull);
  const uint64_t b = mix64(a);
  const uint32_t shuffled = reverse_bits(permute_upwards(reverse_bits(index), static_cast<uint32_t>(a)));
  const uint32_t x = reverse_bits(permute_upwards(shuffled, static_cast<uint32_t>(a >> 32)));
  const uint32_t y = reverse_bits(permute_upwards(pascal_product(shuffled), static_cast<uint32_t>(b >> 32)));
  return {unit(x), unit(y)};
}

}  // namespace relight
