// Expectations on what the radiance meter reads.
#pragma once

#include <gtest/gtest.h>

#include "reference/hard_cases/radiance_meter.h"

namespace relight::check {

// The reading equals `expected` but for noise and `bound`, the largest error of `expected` itself. 5.5
// standard errors of 24 seeds: a false alarm has probability 1.4e-5. `resolution` is the smallest relative
// mistake that must show: a noisier reading proves nothing and fails.
inline void expect_reads(const Reading& reading, const glm::dvec3& expected, const glm::dvec3& bound,
                         double resolution) {
  EXPECT_EQ(reading.non_finite, 0);
  for (int c = 0; c < 3; ++c) {
    const double allowed = 5.5 * reading.error[c] + bound[c] + rounding * expected[c];
    EXPECT_LE(std::abs(reading.mean[c] - expected[c]), allowed)
        << "channel " << c << ": read " << reading.mean[c] << " +- " << reading.error[c] << ", expected "
        << expected[c] << " +- " << bound[c];
    EXPECT_LE(allowed, resolution * expected[c] + 1e-12) << "channel " << c << ": too noisy to tell";
  }
}
inline void expect_reads(const Reading& reading, const glm::dvec3& expected, double bound,
                         double resolution) {
  expect_reads(reading, expected, glm::dvec3(bound), resolution);
}

}  // namespace relight::check
