#include "common/wavelet/haar.h"

#include <glm/glm.hpp>

#include "common/run/error.h"

namespace relight::wavelet {

bool is_power_of_four(int64_t n) { return n > 0 && (n & (n - 1)) == 0 && (n & 0x5555555555555555ll) != 0; }

uint32_t level_nodes(uint32_t index) {
  uint32_t m = 1;
  while (m <= index / 4) m *= 4;
  return m;
}

namespace {
void check_size(size_t n) {
  if (!is_power_of_four(static_cast<int64_t>(n)))
    fail("Haar transform: {} values, expected a power of four", n);
}
}  // namespace

template <typename T>
std::vector<T> forward(const std::vector<T>& values) {
  check_size(values.size());
  std::vector<T> out(values.size());
  std::vector<T> scaling = values;
  for (size_t m = values.size() / 4; m >= 1; m /= 4) {
    for (size_t i = 0; i < m; ++i) {
      T details[3];
      // In place: scaling[i] is written after 4i..4i+3 were read, and i <= 4i.
      scaling[i] =
          haar_step(scaling[4 * i], scaling[4 * i + 1], scaling[4 * i + 2], scaling[4 * i + 3], details);
      for (size_t t = 0; t < 3; ++t) out[(t + 1) * m + i] = details[t];
    }
  }
  out[0] = scaling[0];
  return out;
}

template <typename T>
std::vector<T> inverse(const std::vector<T>& coefficients) {
  check_size(coefficients.size());
  std::vector<T> scaling(coefficients.size());
  scaling[0] = coefficients[0];
  const T half = T(0.5);
  for (size_t m = 1; m < coefficients.size(); m *= 4) {
    for (size_t i = m; i-- > 0;) {  // downwards: children 4i..4i+3 overwrite only parents already used
      const T s = scaling[i], h = coefficients[m + i], v = coefficients[2 * m + i],
              d = coefficients[3 * m + i];
      scaling[4 * i] = half * (s + h + v + d);
      scaling[4 * i + 1] = half * (s - h + v - d);
      scaling[4 * i + 2] = half * (s + h - v - d);
      scaling[4 * i + 3] = half * (s - h - v + d);
    }
  }
  return scaling;
}

template std::vector<float> forward(const std::vector<float>&);
template std::vector<double> forward(const std::vector<double>&);
template std::vector<glm::vec3> forward(const std::vector<glm::vec3>&);
template std::vector<glm::dvec3> forward(const std::vector<glm::dvec3>&);
template std::vector<float> inverse(const std::vector<float>&);
template std::vector<double> inverse(const std::vector<double>&);
template std::vector<glm::vec3> inverse(const std::vector<glm::vec3>&);

}  // namespace relight::wavelet
