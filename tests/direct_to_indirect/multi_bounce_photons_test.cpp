// Photons and the density estimate, piece by piece: against brute force and on hand-made photon maps.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/run/thread_limit.h"
#include "common/sampling/random.h"
#include "methods/direct_to_indirect/multi_bounce_nearest.h"
#include "methods/direct_to_indirect/multi_bounce_photon_rows.h"
#include "methods/direct_to_indirect/multi_bounce_photons.h"
#include "tests/direct_to_indirect/multi_bounce_setup.h"
#include "tests/support/form_factors.h"

namespace relight::direct_to_indirect {
namespace {

// `count` photons spread at random over the square [0,1]^2 x {0}, of 64 sources.
PhotonMap random_floor(size_t count, const glm::vec3& normal) {
  PhotonMap map;
  for (size_t i = 0; i < count; ++i)
    map.photons.push_back({{random_float(11, 0, i, 0), random_float(11, 0, i, 1), 0.0f},
                           static_cast<uint32_t>(64 * i / count),
                           normal,
                           glm::vec3(1.0f, 0.5f, 0.25f) / static_cast<float>(count)});
  return map;
}

// 64 samples in the middle of the same square, facing up, of albedo 1. The scene is not looked at.
struct Floor {
  BounceSetup setup{closed_box(glm::vec3(1.0f)), 64, true};
  Floor() {
    for (size_t i = 0; i < 64; ++i) {
      SurfaceSample& s = setup.cloud.samples[i];
      s.position = {0.3f + 0.4f * random_float(12, 0, i, 0), 0.3f + 0.4f * random_float(12, 0, i, 1), 0.0f};
      s.geometric_normal = s.shading_normal = {0, 0, 1};
    }
  }
  std::vector<glm::dvec3> row_sums(const PhotonMap& map, int neighbours, int coefficients = 64) const {
    MultiBounceSettings settings = quick_settings(BounceKind::photons, 2);
    settings.neighbours = neighbours, settings.coefficients = coefficients;
    Progress quiet(true);
    StageLog log;
    const SparseRowsRgb rows = photon_rows(setup.input(), map, settings, quiet, log);
    return multiply(rows, wavelet::forward(std::vector<glm::dvec3>(64, glm::dvec3(1.0))));
  }
};

// Red if the pruned result set drops a near photon. No mutation tried yet.
TEST(NearestPhotons, AreThoseOfBruteForce) {
  const PhotonMap map = random_floor(5000, {0, 0, 1});
  const NearestPhotons nearest(map.photons);
  std::vector<Neighbour> found;
  for (uint64_t q = 0; q < 20; ++q) {
    const glm::vec3 p(random_float(13, q, 0, 0), random_float(13, q, 1, 0), 0.1f * random_float(13, q, 2, 0));
    std::vector<std::pair<float, uint32_t>> all;
    for (uint32_t i = 0; i < map.photons.size(); ++i) {
      const glm::vec3 d = map.photons[i].position - p;
      all.emplace_back(glm::dot(d, d), i);
    }
    std::sort(all.begin(), all.end());
    for (const size_t count : {1u, 7u, 300u, 5000u, 6000u}) {
      nearest.find(p, count, found);
      ASSERT_EQ(found.size(), std::min(count, all.size()));
      std::sort(found.begin(), found.end(),
                [](const auto& a, const auto& b) { return a.distance2 < b.distance2; });
      // Distances summed in another order may differ in the last bit.
      for (size_t i = 0; i < found.size(); ++i)
        ASSERT_NEAR(found[i].distance2, all[i].first, 1e-6f * all[i].first);
    }
  }
}

// Density 1 of weights (1, 1/2, 1/4): with 5 neighbours a row sum is 1 on average if the fifth is left out,
// 5/4 if it counts. Its deviation is 1/sqrt(3); 64 rows from 40 maps whose discs hardly overlap. No mutation
// tried yet.
TEST(PhotonRows, FewNeighboursGiveAnUnbiasedDensity) {
  const Floor samples;
  glm::dvec3 mean(0.0);
  for (uint64_t seed = 0; seed < 40; ++seed) {
    PhotonMap map = random_floor(4000, {0, 0, 1});
    for (size_t i = 0; i < map.photons.size(); ++i)
      map.photons[i].position = {random_float(seed, 14, i, 0), random_float(seed, 14, i, 1), 0.0f};
    for (const glm::dvec3& sum : samples.row_sums(map, 5)) mean += sum / (40.0 * 64.0);
  }
  EXPECT_NEAR(mean.x, 1.0, 0.05);
  EXPECT_NEAR(mean.y, 0.5, 0.025);
  EXPECT_NEAR(mean.z, 0.25, 0.0125);
}

// Whatever is kept of a row, its sum is in the scaling coefficient, which weighs most. Red if it is dropped.
TEST(PhotonRows, TruncationKeepsTheRowSum) {
  const Floor samples;
  const PhotonMap map = random_floor(20000, {0, 0, 1});
  const auto all = samples.row_sums(map, 1000), few = samples.row_sums(map, 1000, 3);
  for (size_t i = 0; i < 64; ++i) EXPECT_NEAR(few[i].x, all[i].x, 1e-6 * all[i].x);
}

// Light that hit the back of a sheet, or a wall at right angles, does not light its front; what hit a surface
// 30 degrees off does. No mutation tried yet.
TEST(PhotonRows, CountPhotonsOfTheSameSideOnly) {
  const Floor samples;
  const float angle = std::numbers::pi_v<float> / 6.0f;
  for (const auto& [normal, expected] :
       {std::pair{glm::vec3(0, 0, 1), 1.0}, std::pair{glm::vec3(0, 0, -1), 0.0},
        std::pair{glm::vec3(1, 0, 0), 0.0}, std::pair{glm::vec3(std::sin(angle), 0, std::cos(angle)), 1.0}})
    for (const glm::dvec3& sum : samples.row_sums(random_floor(20000, normal), 1000))
      EXPECT_NEAR(sum.x, expected, 0.2 * expected);
}

// One photon, or a thousand at one place under the sample: no disc, an empty row, and a count of it, not NaN.
TEST(PhotonRows, WithoutARadiusAreEmptyAndCounted) {
  Floor samples;
  for (SurfaceSample& s : samples.setup.cloud.samples) s.position = glm::vec3(0.5f, 0.5f, 0.0f);
  for (const size_t count : {0u, 1u, 1000u}) {
    PhotonMap map = random_floor(count, {0, 0, 1});
    for (Photon& p : map.photons) p.position = glm::vec3(0.5f, 0.5f, 0.0f);
    const MultiBounceSettings settings = quick_settings(BounceKind::photons, 2);
    Progress quiet(true);
    StageLog log;
    const SparseRowsRgb rows = photon_rows(samples.setup.input(), map, settings, quiet, log);
    EXPECT_TRUE(rows.entries.empty()) << count;
    EXPECT_EQ(log.counters().at("photon_discs_empty"), 64) << count;
  }
}

// In a closed box no photon is lost: as many hits a path as it may have, and every hit's flux is the emitted
// one times the albedos before it. Red if a hit's own albedo is multiplied in, or the flux is not split among
// the n photons.
TEST(Photons, KeepTheirFluxTimesTheAlbedosPassed) {
  const glm::vec3 a(0.9f, 0.5f, 0.1f);
  const BounceSetup s(closed_box(a), 256, true);
  MultiBounceSettings settings = quick_settings(BounceKind::photons, 4);
  settings.photons = 256 * 15;
  const PhotonMap map = trace_photons(s.input(), settings);
  EXPECT_EQ(map.shot, 256 * 15);
  ASSERT_EQ(map.photons.size(), 3u * 256u * 15u);
  glm::dvec3 flux(0.0);
  for (const Photon& p : map.photons) flux += glm::dvec3(p.area);
  for (int c = 0; c < 3; ++c) {
    const double albedo = static_cast<double>(a[c]);
    EXPECT_NEAR(flux[c], 6.0 * (1.0 + albedo + albedo * albedo), 1e-3) << "channel " << c;
  }
}

// How many photons of a face land on the opposite one, and on the nearer halves of its neighbours, is
// analytic. Red if directions are spread evenly over the hemisphere. No mutation tried yet.
TEST(Photons, LeaveASampleByLambertsLaw) {
  const BounceSetup s(closed_box(glm::vec3(0.5f)), 1024, true);
  MultiBounceSettings settings = quick_settings(BounceKind::photons, 2);
  settings.photons = 1024 * 100;
  const PhotonMap map = trace_photons(s.input(), settings);
  double emitted = 0.0, opposite = 0.0, low_half = 0.0;
  for (const Photon& p : map.photons) {
    const SurfaceSample& from = s.cloud.samples[p.source];
    emitted += static_cast<double>(p.area.x);
    const float along = glm::dot(p.normal, from.geometric_normal);
    if (along < -0.5f) opposite += static_cast<double>(p.area.x);
    if (std::abs(along) < 0.5f &&
        std::abs(glm::dot(p.position - from.position, from.geometric_normal)) < 0.5f)
      low_half += static_cast<double>(p.area.x);
  }
  const check::Rectangle floor{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, ceiling{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
      half_wall{{0, 0, 0}, {0, 0.5, 0}, {0, 0, 1}};
  // 102,400 stratified photons: a deviation of less than 0.0013 and 0.0016.
  EXPECT_NEAR(opposite / emitted, check::form_factor(floor, ceiling), 0.005);
  EXPECT_NEAR(low_half / emitted, 4.0 * check::form_factor(floor, half_wall), 0.006);
}

// Red if a random number or a sum depends on the thread. No mutation tried yet.
TEST(MultiBounce, HasTheSameBitsForOneAndTwoThreads) {
  const BounceSetup s(tiny::room(), 1024, false);
  for (const BounceKind kind : {BounceKind::photons, BounceKind::transfer}) {
    std::vector<MultiBounce> runs;
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      runs.push_back(s.compute(quick_settings(kind, 3)));
    }
    EXPECT_EQ(runs[0].share_beyond, runs[1].share_beyond);
    EXPECT_EQ(runs[0].photons.row_start, runs[1].photons.row_start);
    EXPECT_EQ(runs[0].transfer.row_start, runs[1].transfer.row_start);
    for (size_t e = 0; e < runs[0].photons.entries.size(); ++e) {
      ASSERT_EQ(runs[0].photons.entries[e].column, runs[1].photons.entries[e].column);
      ASSERT_EQ(runs[0].photons.entries[e].value, runs[1].photons.entries[e].value);
    }
    for (size_t e = 0; e < runs[0].transfer.entries.size(); ++e) {
      ASSERT_EQ(runs[0].transfer.entries[e].column, runs[1].transfer.entries[e].column);
      ASSERT_EQ(runs[0].transfer.entries[e].value, runs[1].transfer.entries[e].value);
    }
    EXPECT_GT(runs[0].photons.entries.size() + runs[0].transfer.entries.size(), 10000u);
  }
}

// A change of variables: M' (w g) = w (M g) without truncation. Red if a column is multiplied where it is to
// be divided, or the row's factor is forgotten. Links to single samples only, as for the final gather.
TEST(MultiBounce, ColumnScalingChangesNoUntruncatedProduct) {
  BounceSetup s(closed_box(glm::vec3(0.8f, 0.5f, 0.2f)), 256, true);
  for (const BounceKind kind : {BounceKind::photons, BounceKind::transfer}) {
    MultiBounceSettings settings = quick_settings(kind, 3);
    settings.coefficients = 256, settings.photons = 20000, settings.gather.link_threshold = 0.0f;
    std::vector<glm::dvec3> g(256), scaled_g(256);
    std::vector<float> w(256);
    for (size_t i = 0; i < 256; ++i) {
      w[i] = 0.5f + 2.0f * random_float(15, 0, i, 0);
      g[i] = glm::dvec3(random_float(15, 0, i, 1));
      scaled_g[i] = static_cast<double>(w[i]) * g[i];
    }
    s.column_scale.clear();
    const MultiBounce plain = s.compute(settings);
    const std::vector<glm::dvec3> expected = bounced(s, plain, g);
    s.column_scale = w;
    const MultiBounce scaled = s.compute(settings);
    EXPECT_NEAR(scaled.share_beyond, plain.share_beyond, 1e-5);
    const GatherCloud cloud = s.cloud;
    for (size_t i = 0; i < 256; ++i) s.cloud.samples[i].diffuse *= w[i];  // as precompute leaves them
    const std::vector<glm::dvec3> got = bounced(s, scaled, scaled_g);
    s.cloud = cloud;
    for (size_t i = 0; i < 256; ++i)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(got[i][c], static_cast<double>(w[i]) * expected[i][c], 1e-4 * expected[i][c]) << i;
  }
}

}  // namespace
}  // namespace relight::direct_to_indirect
