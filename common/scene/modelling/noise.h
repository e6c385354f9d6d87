// Smooth pseudo-random height in [0,1] over the plane: value noise with a quintic blend, summed over octaves.
#pragma once

#include <cmath>
#include <cstdint>

#include "common/sampling/random.h"

namespace relight::modelling {

inline double value_noise(double x, double y, uint64_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto corner = [&](int dx, int dy) {
    const auto ix = static_cast<int64_t>(fx) + dx, iy = static_cast<int64_t>(fy) + dy;
    return double(random_float(seed, 0x6e6f697365ull, static_cast<uint64_t>(ix), static_cast<uint64_t>(iy)));
  };
  const auto blend = [](double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); };
  const double u = blend(x - fx), v = blend(y - fy);
  const double low = (1 - u) * corner(0, 0) + u * corner(1, 0),
               high = (1 - u) * corner(0, 1) + u * corner(1, 1);
  return (1 - v) * low + v * high;
}

inline double fractal_noise(double x, double y, int octaves, uint64_t seed) {
  double sum = 0.0, weight = 0.5, total = 0.0;
  for (int i = 0; i < octaves; ++i, x *= 2.0, y *= 2.0, weight *= 0.5) {
    sum += weight * value_noise(x, y, seed + static_cast<uint64_t>(i));
    total += weight;
  }
  return sum / total;
}

}  // namespace relight::modelling
