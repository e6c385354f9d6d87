// Cornell-type boxes against a dense radiosity solution: walls of three colours, a lamp or a point light, a
// block that casts shadows. Nothing but the scene is shared with the path tracer.
//
// The expected value is Richardson's extrapolation from cells of 1/6 and 1/12. The error falls with the
// square of the cell size: against cells of 1/12 and 1/24 the extrapolation was off by at most 0.12 % in the
// empty room. With a block, points are counted to decide what is visible: 0.42 %.
#include <cmath>

#include "tests/support/radiance_meter.h"
#include "tests/support/radiosity_rooms.h"

namespace relight::check {
namespace {

const glm::dvec3 lamp_position(0.62, 0.7, 0.41), lamp_intensity(1.0, 0.9, 0.7);

// Points away from the edges of cells and walls, each seen along its normal from `distance`.
struct Probe {
  glm::dvec3 point, normal, albedo;
};
const Probe probes[] = {
    {{0.71, 0.0, 0.31}, {0, 1, 0}, {0.7, 0.68, 0.6}},    // floor
    {{0.0, 0.37, 0.28}, {1, 0, 0}, {0.6, 0.1, 0.08}},    // red wall, behind the block's corner
    {{1.0, 0.63, 0.57}, {-1, 0, 0}, {0.15, 0.5, 0.12}},  // green wall
    {{0.53, 0.21, 0.0}, {0, 0, 1}, {0.7, 0.68, 0.6}},    // back wall
};
constexpr double distance = 0.15;

struct Solved {
  RadiosityRoom solver;
  Radiosities source;  // what shines or is lit before any bounce
  Solved(const Room& room, bool lamp, double cell)
      : solver(room.surfaces, room.block, cell),
        source(lamp ? solver.emitted() : solver.lit_by(lamp_position, lamp_intensity)) {}
  // Radiance of a probe for light that left the lit or shining cells `bounces` bounces before; all from there
  // on if `and_more`.
  glm::dvec3 radiance(const Probe& probe, int bounces, bool and_more) const {
    Radiosities b = source;
    for (int i = 0; i < bounces; ++i) b = solver.bounce(b);
    if (and_more) b = solver.solve(b);
    return probe.albedo / M_PI * solver.irradiance(probe.point, probe.normal, b);
  }
};

struct Expected {
  glm::dvec3 value, bound;
};

// Richardson's extrapolation. Its bound: the finer solution is a third of the difference away from it; half
// of the difference and `visibility` are more than was ever found.
Expected extrapolated(const glm::dvec3& coarse, const glm::dvec3& fine, double visibility) {
  return {fine + (fine - coarse) / 3.0, 0.5 * glm::abs(fine - coarse) + visibility * fine};
}

constexpr int most_bounces = 48;  // albedo 0.7: what is left after them is below 1e-7

// Mean of reading / expected over all readings of a room, sharper than each of them.
struct MeanRatio {
  double sum = 0.0, variance = 0.0, bound = 0.0;
  int count = 0;
  void add(const Reading& reading, const Expected& expected) {
    sum += reading.mean.x / expected.value.x, ++count;
    variance += std::pow(reading.error.x / expected.value.x, 2), bound += expected.bound.x / expected.value.x;
  }
  void expect_one(double resolution) const {
    const double allowed = (5.5 * std::sqrt(variance) + bound) / count;
    EXPECT_NEAR(sum / count, 1.0, allowed) << "mean over the room";
    EXPECT_LT(allowed, resolution) << "mean over the room: too noisy to tell";
  }
};

// One bounce, two bounces, and all beyond them, at every probe: within 25 % in each
// channel (the red wall is nearly black in two), 2.5 % in the mean.
void expect_radiosity(bool lamp, bool block, Effort effort) {
  const Room room = cornell_room(lamp, block);
  const Solved coarse(room, lamp, 1.0 / 6.0), fine(room, lamp, 1.0 / 12.0);
  const LightingState lights =
      lamp ? LightingState{}
           : tiny::lighting({tiny::omni(glm::vec3(lamp_position), glm::vec3(lamp_intensity))});
  const RadianceMeter meter(room.scene(), lights);
  const int shift = lamp ? 0 : 1;  // what a point light lights directly sends its light with 1 bounce
  MeanRatio ratio;
  for (const Probe& probe : probes)
    for (int k = 0; k <= 2; ++k) {
      const bool all = k == 2;
      SCOPED_TRACE(testing::Message() << "point " << probe.point.x << " " << probe.point.y << " "
                                      << probe.point.z << ", " << k << (all ? "+" : "") << " bounces");
      const Light light{k + shift, all ? most_bounces : k + shift, lamp, false, false};
      effort.first_seed += 1000;
      const Reading reading =
          meter.read(glm::vec3(probe.point + distance * probe.normal), glm::vec3(probe.point), light, effort);
      const Expected expected =
          extrapolated(coarse.radiance(probe, k, all), fine.radiance(probe, k, all), block ? 0.005 : 0.001);
      expect_reads(reading, expected.value, expected.bound, 0.25);
      ratio.add(reading, expected);
    }
  ratio.expect_one(0.025);
}

// Red if: any factor of any bounce is wrong, or light passes through the block. Tried: throughput x 1.02, the
// second bounce dropped, the block's shadow rays let through, emission counted from the second vertex on.
TEST(RadiosityBox, LampInAnEmptyRoom) { expect_radiosity(true, false, {256, 24}); }
TEST(RadiosityBox, LampAndBlock) { expect_radiosity(true, true, {384, 24}); }
TEST(RadiosityBox, PointLightByNextEvent) { expect_radiosity(false, true, {128, 24}); }
TEST(RadiosityBox, PointLightByLightVertices) {
  expect_radiosity(false, true, {96, 24, Estimator::light_vertex});
}

}  // namespace
}  // namespace relight::check
