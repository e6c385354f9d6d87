// Closed rooms of one albedo a under even light: each bounce multiplies the light by a, so every row of M
// sums to a + a^2 + ... + a^(bounces - 1).
#include <cmath>

#include <gtest/gtest.h>

#include "tests/direct_to_indirect/multi_bounce_setup.h"

namespace relight::direct_to_indirect {
namespace {

constexpr int64_t samples = 1024;
const glm::vec3 grey_to_black(0.8f, 0.5f, 0.2f);

glm::dvec3 series(const glm::vec3& a, int bounces) {
  glm::dvec3 sum(0.0), power(1.0);
  for (int k = 1; k < bounces; ++k) power *= glm::dvec3(a), sum += power;
  return sum;
}

// Row sum / series over the samples at least `from_edge` away from the edges of the unit cube.
struct RowSums {
  glm::dvec3 mean{0.0};
  double smallest = INFINITY, largest = 0.0;
};
RowSums row_sums(const BounceSetup& s, const MultiBounce& m, const glm::vec3& a, float from_edge) {
  const std::vector<glm::dvec3> sums = bounced(s, m, std::vector<glm::dvec3>(samples, glm::dvec3(1.0)));
  RowSums out;
  double count = 0.0;
  for (size_t i = 0; i < sums.size(); ++i) {
    if (from_edge > 0.0f && edge_distance(s.cloud.samples[i].position) < from_edge) continue;
    const glm::dvec3 ratio = sums[i] / series(a, m.bounces);
    out.mean += ratio, count += 1.0;
    for (int c = 0; c < 3; ++c)
      out.smallest = std::min(out.smallest, ratio[c]), out.largest = std::max(out.largest, ratio[c]);
  }
  out.mean /= count;
  return out;
}

void expect_mean_one(const RowSums& sums, double bound) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sums.mean[c], 1.0, bound) << "channel " << c;
}

// A sphere has no edges over which a disc could hang. 300 photons a row: deviation 1/sqrt(299) = 5.8 %,
// somewhat more where they differ in weight; that of the mean over 1024 rows of 300,000 hits is 0.2 %, and
// the bounds are five deviations. Red if flux, albedo, pi, n or the disc has a wrong factor. No mutation
// tried yet.
TEST(MultiBounceFurnace, PhotonRowsInASphereSumToTheSeries) {
  const BounceSetup s(closed_sphere(grey_to_black), samples, true);
  const MultiBounce m = s.compute(quick_settings(BounceKind::photons, 4));
  const RowSums sums = row_sums(s, m, grey_to_black, 0.0f);
  expect_mean_one(sums, 0.01);
  EXPECT_GT(sums.smallest, 0.6);
  EXPECT_LT(sums.largest, 1.4);
}

// Away from the edges rows are as good as in the sphere; over all rows the discs that hang over the edges
// lose 5 to 10 % of a bounce at this number of photons: the known darkening, which must not get worse
// unnoticed.
TEST(MultiBounceFurnace, PhotonRowsInABoxSumToTheSeriesAwayFromEdgesAndDarkenThere) {
  const BounceSetup s(closed_box(grey_to_black), samples, true);
  const MultiBounce m = s.compute(quick_settings(BounceKind::photons, 2));
  expect_mean_one(row_sums(s, m, grey_to_black, 0.1f), 0.015);
  const RowSums all = row_sums(s, m, grey_to_black, 0.0f);
  EXPECT_GT(all.mean.x, 0.90);
  EXPECT_LT(all.mean.x, 0.98);
}

// Red if a row takes another sample's place in its tile, rho is applied once too often, or a cluster's mean
// counts the areas of all its members (the last tried).
TEST(MultiBounceFurnace, TransferRowsInASphereSumToTheSeries) {
  const BounceSetup s(closed_sphere(grey_to_black), samples, true);
  MultiBounceSettings settings = quick_settings(BounceKind::transfer, 4);
  for (const bool mean_elements : {false, true}) {
    settings.gather.mean_elements = mean_elements;
    const MultiBounce m = s.compute(settings);
    const RowSums sums = row_sums(s, m, grey_to_black, 0.0f);
    expect_mean_one(sums, 0.005);
    EXPECT_GT(sums.smallest, 0.9);
    EXPECT_LT(sums.largest, 1.1);
  }
}

// In corners the clamp of 0.1 takes light away, and bounces carry the loss on.
TEST(MultiBounceFurnace, TransferRowsInABoxSumToTheSeriesAwayFromEdges) {
  const BounceSetup s(closed_box(grey_to_black), samples, true);
  for (const int bounces : {2, 4}) {
    const MultiBounce m = s.compute(quick_settings(BounceKind::transfer, bounces));
    const RowSums sums = row_sums(s, m, grey_to_black, 0.1f);
    expect_mean_one(sums, bounces == 2 ? 0.01 : 0.04);
  }
}

// Closed rooms of albedo 1 lose nothing, of albedo 0 have no bounce. Red if a path of no energy is followed,
// or a divergent series gives a finite share. No mutation tried yet.
TEST(MultiBounceFurnace, AlbedoOneKeepsAllLightAndAlbedoZeroNone) {
  for (const BounceKind kind : {BounceKind::photons, BounceKind::transfer}) {
    const BounceSetup white(closed_sphere(glm::vec3(1.0f)), samples, true),
        black(closed_sphere(glm::vec3(0.0f)), samples, true);
    MultiBounceSettings settings = quick_settings(kind, 4);
    settings.photons = 20000;
    StageLog log;
    const MultiBounce bright = white.compute(settings), dark = black.compute(settings, log);
    expect_mean_one(row_sums(white, bright, glm::vec3(1.0f), 0.0f), 0.01);
    for (const glm::dvec3& v : bounced(black, dark, std::vector<glm::dvec3>(samples, glm::dvec3(1.0))))
      ASSERT_EQ(v, glm::dvec3(0.0));
    EXPECT_GT(bright.share_beyond, 0.9);
    EXPECT_EQ(dark.share_beyond, 0.0);
    if (kind == BounceKind::transfer) continue;
    EXPECT_EQ(log.counters().at("photon_rays"), log.counters().at("photons"));
  }
}

// Of albedo 0.95, a^4 = 81 % of all light comes after the fourth bounce: reported, with a warning; of albedo
// 0.3, 0.8 %: no warning. Red if the series starts at the wrong bounce (a^3 or a^5 is 4 points off). Tried:
// the tail without its first ratio.
TEST(MultiBounceFurnace, ReportsTheShareOfLightBeyondTheLastBounce) {
  for (const BounceKind kind : {BounceKind::photons, BounceKind::transfer})
    for (const float a : {0.95f, 0.3f}) {
      const BounceSetup s(closed_sphere(glm::vec3(a)), samples, true);
      MultiBounceSettings settings = quick_settings(kind, 4);
      settings.photons = 20000;
      const MultiBounce m = s.compute(settings);
      StageLog log;
      report_share_beyond(m, log);
      const double expected = std::pow(static_cast<double>(a), 4);
      EXPECT_NEAR(m.share_beyond, expected, 0.01);
      EXPECT_NEAR(1e-6 * static_cast<double>(log.counters().at("bounce_energy_beyond_ppm")), m.share_beyond,
                  1e-6);
      EXPECT_EQ(log.warnings().size(), a > 0.9f ? 1u : 0u);
    }
}

}  // namespace
}  // namespace relight::direct_to_indirect
