// Directions of the environment as samples that matrices have columns for (Hasan 2006 section 6: the gather
// cloud split into surface samples and environment samples).
//
// The sphere is folded out to a square of 4^n texels of equal solid angle, 4 pi / 4^n each: the equal-area
// octahedral map of Clarberg ("Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", JGT 2008).
// Derivation: on the upper hemisphere take r = sqrt(1 - y), the radius of the equal-area disc, and the
// azimuth as share f of its quadrant. The cap of radius r has the share r^2 of the hemisphere's area, and so
// has the diamond |u| + |v| <= r of the diamond |u| + |v| <= 1; along the diamond's side area is linear in f.
// Hence |u| = r (1 - f), |v| = r f. The lower hemisphere fills the four corners, mirrored at the diamond's
// sides: (|u|, |v|) -> (1 - |v|, 1 - |u|).
//
// Texels are numbered along the Morton curve: the square is a quad-tree, and a vector of texels is in tree
// order (common/wavelet/haar.h) as it is.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>

#include "common/lights/environment.h"

namespace relight {

class EnvironmentSquare {
 public:
  // Throws Error unless `texels` is a power of four between 4 and 4^10.
  explicit EnvironmentSquare(int64_t texels);

  uint32_t texels() const { return side_ * side_; }
  double solid_angle() const {
    return 4.0 * std::numbers::pi / static_cast<double>(texels());
  }  // of a texel [sr]
  // Unit direction of a place in a texel, (0,0) to (1,1) from corner to corner; equal areas are equal solid
  // angles.
  glm::dvec3 direction(uint32_t texel, const glm::dvec2& place) const;
  // The texel that holds a unit direction.
  uint32_t texel_of(const glm::vec3& direction) const;
  // The same for the direction with height y = cos(polar angle) and azimuth = atan2(x, -z) in radians, which
  // may be any number of turns.
  uint32_t texel_of(double y, double azimuth) const;

 private:
  uint32_t side_;
};

// Mean radiance of the environment over each texel. The map's bilinear interpolation is summed at the centres
// of a fine grid over each texel of the *map*, with their exact solid angles: nothing of the map is skipped,
// so that mean x solid angle, summed over the square, is the map's integral to rounding, and a sun of one
// texel keeps all of its light. Each texel of the square gets a thousand points or more: those that cross its
// rim change it by up to 3 %, and its neighbour the other way (tests/sampling/environment_samples_test.cpp).
// A constant environment is exact. Parallel, the same bits for any number of threads.
std::vector<glm::dvec3> mean_radiance(const Environment& environment, const EnvironmentSquare& square);

// Means over all nodes of the quad-tree, from the root to the texels: those of level l begin at
// pyramid_begin(l).
std::vector<glm::dvec3> radiance_pyramid(const std::vector<glm::dvec3>& texels);
constexpr uint32_t pyramid_begin(int level) { return ((uint32_t{1} << (2 * level)) - 1) / 3; }

// Do both give the same light from everywhere? File names don't count.
bool same_environment(const Environment& a, const Environment& b);

}  // namespace relight
