// M against a dense radiosity solution (tests/support/radiosity.h) of a room with coloured walls whose floor
// alone shines: no photon, link or wavelet in it.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/direct_to_indirect/multi_bounce_setup.h"
#include "tests/support/radiosity_rooms.h"

namespace relight::direct_to_indirect {
namespace {

constexpr size_t floor_face = 2, samples = 4096;

// The empty Cornell room; face `floor_face` of radiance (1, 1, 1).
check::Room room_with_shining_floor() {
  check::Room room = check::cornell_room(false, false);
  for (check::Surface& s : room.surfaces)
    if (s.shape.normal().y > 0.5) s.emission = glm::dvec3(1.0);
  return room;
}

// Radiance that sample s reflects of 1 to `bounces` - 1 bounces.
struct Solution {
  check::RadiosityRoom solver;
  check::Radiosities source;
  Solution(const check::Room& room, double cell, int bounces) : solver(room.surfaces, room.block, cell) {
    check::Radiosities wave = solver.emitted();
    source = wave;
    for (int k = 2; k < bounces; ++k) {
      wave = solver.bounce(wave);
      for (size_t i = 0; i < source.size(); ++i) source[i] += wave[i];
    }
  }
  glm::dvec3 radiance(const SurfaceSample& s) const {
    return glm::dvec3(s.diffuse) / M_PI *
           solver.irradiance(glm::dvec3(s.position), glm::dvec3(s.geometric_normal), source);
  }
};

// Four bounces. Solved once for all tests.
struct LitRoom {
  check::Room room = room_with_shining_floor();
  BounceSetup setup{room.scene(), samples, false};  // fronts face the inside
  Solution solution{room, 1.0 / 6.0, 4};
  std::vector<glm::dvec3> direct, expected;  // expected: of every seventh sample, away from the edges; else 0
  LitRoom() : direct(samples, glm::dvec3(0.0)), expected(samples, glm::dvec3(0.0)) {
    for (size_t i = 0; i < samples; ++i) {
      const SurfaceSample& s = setup.cloud.samples[i];
      if (s.geometric_normal.y > 0.5f) direct[i] = glm::dvec3(1.0);
      if (i % 7 == 0 && edge_distance(s.position) > 0.08f) expected[i] = solution.radiance(s);
    }
  }
};
const LitRoom& lit_room() {
  static const LitRoom room;
  return room;
}

// Relative L2 difference and bias of M g from the solution.
struct Difference {
  double norm, bias;
};
Difference difference(BounceKind kind, int coefficients) {
  const LitRoom& room = lit_room();
  MultiBounceSettings settings = quick_settings(kind, 4);
  settings.coefficients = coefficients;
  settings.photons = 400000, settings.neighbours = 1200;
  const std::vector<glm::dvec3> got = bounced(room.setup, room.setup.compute(settings), room.direct);
  glm::dvec3 difference2(0.0), norm2(0.0), sum(0.0), expected_sum(0.0);
  for (size_t i = 0; i < samples; ++i) {
    const glm::dvec3& expected = room.expected[i];
    if (expected == glm::dvec3(0.0)) continue;
    const glm::dvec3 d = got[i] - expected;
    difference2 += d * d, norm2 += expected * expected, sum += d, expected_sum += expected;
  }
  const auto total = [](const glm::dvec3& v) { return v.x + v.y + v.z; };
  const Difference out{std::sqrt(total(difference2) / total(norm2)), total(sum) / total(expected_sum)};
  return out;
}

// The floor's photons are about a sixth of the 1200 in a disc: 7 % of noise a sample. 6 deviations of the
// mean over all photons of the floor are 2 %. Red if a colour is taken from the wrong end of a path, or hits
// of the first bounce only are kept. No mutation tried yet.
TEST(MultiBounceRadiosity, PhotonsGiveTheSolutionButForTheirNoise) {
  const Difference all = difference(BounceKind::photons, samples),
                   forty = difference(BounceKind::photons, 40);
  EXPECT_LT(all.norm, 0.10);
  EXPECT_LT(std::abs(all.bias), 0.02);
  EXPECT_LT(forty.norm, 0.12) << "40 coefficients a row";
}

// Without noise; the clamp in the corners makes it darker, 40 coefficients a row coarser.
TEST(MultiBounceRadiosity, TransferGivesTheSolution) {
  const Difference all = difference(BounceKind::transfer, samples),
                   forty = difference(BounceKind::transfer, 40);
  EXPECT_LT(all.norm, 0.02);
  EXPECT_LT(std::abs(all.bias), 0.012);
  EXPECT_LT(forty.norm, 0.07) << "40 coefficients a row";
}

}  // namespace
}  // namespace relight::direct_to_indirect
