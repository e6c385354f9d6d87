// Lights and views at which a relight could divide by zero, lose its cone or find nothing to light. Stated
// bound for all of them: every pixel finite, nothing replaced, and the fast CPU path within 6e-6 of the
// picture of the double-precision oracle (100 roundings of 2^-24; see transfer_cpu_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "tests/support/tiny_scenes.h"
#include "tests/support/transfer_bench.h"

namespace relight {
namespace {

using test::relative_difference;
using test::TransferBench;

bool all_finite(const Image& image) {
  for (const glm::vec3& p : image.pixels)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  return true;
}

// Relights on both devices; returns the CPU's picture.
Relit relit_by_both(TransferBench& bench, const Light& light) {
  StageLog cpu_log, oracle_log;
  const LightingState lighting = tiny::lighting({light});
  Relit cpu = bench.prepare({{"device", "cpu"}, {"weights", "float32"}})->relight(lighting, cpu_log);
  const Relit oracle =
      bench.prepare({{"device", "oracle"}, {"shadows", "traced"}})->relight(lighting, oracle_log);
  EXPECT_TRUE(all_finite(cpu.total) && all_finite(oracle.total));
  EXPECT_TRUE(cpu_log.warnings().empty() && oracle_log.warnings().empty());
  EXPECT_LE(relative_difference(cpu.direct, oracle.direct), 6e-6);
  EXPECT_LE(relative_difference(cpu.indirect, oracle.indirect), 6e-6);
  return cpu;
}

// Red if a quad without samples lights up, or a miss takes a neighbour's indirect light.
TEST(RelightHardCases, BackgroundStaysBlackBesideAThinStripOfScene) {
  TransferBench bench([] {
    Scene scene = tiny::room();
    scene.camera.target += glm::vec3(2.75f, 0.0f, 0.0f);  // the room ends in the leftmost pixels
    finish_scene(scene);
    return scene;
  }());
  const Relit relit = relit_by_both(bench, tiny::omni({0.0f, 0.2f, 0.6f}));
  size_t background = 0, lit = 0;
  for (size_t i = 0; i < relit.total.pixels.size(); ++i) {
    const size_t x = i % 40, y = i / 40;
    bool hit = bench.buffer.indirect[i].valid;
    for (size_t s = 0; s < 4; ++s)
      hit = hit || bench.buffer.direct[(2 * y + s / 2) * 80 + 2 * x + s % 2].valid;
    background += !hit;
    const bool black = relit.total.pixels[i] == glm::vec3(0.0f);
    EXPECT_TRUE(hit || black) << x << ' ' << y;
    lit += !black;
  }
  EXPECT_GT(background, 800u);
  EXPECT_GT(lit, 10u);
}

TEST(RelightHardCases, ABlackLightGivesABlackPictureWithoutAnyRay) {
  TransferBench bench(tiny::room());
  StageLog log;
  const Light black = tiny::omni({0.3f, 0.6f, 0.4f}, glm::vec3(0.0f));
  const Relit relit = bench.prepare({{"device", "cpu"}})->relight(tiny::lighting({black}), log);
  EXPECT_EQ(test::norm(relit.total), 0.0);
  EXPECT_EQ(log.counters().at("lights_shaded"), 0);
  EXPECT_EQ(log.counters().count("shadow_rays"), 0u);
}

// The block of the room is closed: a light inside reaches nothing that the camera sees. Red if rays start on
// the wrong side of a surface (tried: the offset's sign turned).
TEST(RelightHardCases, ALightInsideASolidGivesABlackPicture) {
  TransferBench bench(tiny::room());
  const Relit relit = relit_by_both(bench, tiny::omni({-0.3f, -0.5f, -0.3f}));
  EXPECT_EQ(test::norm(relit.direct), 0.0);
}

// Exactly at a sample of the view, and 1e-5 above one. Red if 0/0 or overflow reaches the picture.
TEST(RelightHardCases, ALightAtASampleIsFinite) {
  TransferBench bench(tiny::room(2.0f, glm::vec3(0.0f), true));
  const SurfaceSample& s = bench.buffer.direct[41 * 80 + 33];
  ASSERT_TRUE(s.valid);
  relit_by_both(bench, tiny::omni(s.position));
  EXPECT_GT(test::norm(relit_by_both(bench, tiny::omni(s.position + 1e-5f * s.geometric_normal)).direct),
            0.0);
}

// Full opening 0.1 degrees (cosines of inner and outer cone differ by a few roundings) and 179 degrees. Red
// if culling works with the angle's rounded cosine as if it were exact.
TEST(RelightHardCases, ConesOfATenthOfADegreeAndOf179DegreesLightWhatTheyShould) {
  TransferBench bench(tiny::room());
  const glm::vec3 position(0.5f, 0.9f, 0.2f);
  const SurfaceSample& target = bench.buffer.direct[47 * 80 + 40];
  ASSERT_TRUE(target.valid);
  const Light needle = tiny::spot(position, target.position - position, 0.02f, 0.05f, glm::vec3(100.0f));
  const Relit thin = relit_by_both(bench, needle);
  EXPECT_GT(test::norm(thin.direct), 0.0);
  // Every pixel has between the least and the largest of its four sub-samples' shares of the omni's light.
  const Light wide = tiny::spot(position, {0, -1, 0}, 60.0f, 89.5f), omni = tiny::omni(position);
  const Image by_spot = relit_by_both(bench, wide).direct, by_omni = relit_by_both(bench, omni).direct;
  size_t partly = 0;
  for (size_t i = 0; i < by_spot.pixels.size(); ++i) {
    float least = 1.0f, largest = 0.0f;
    for (size_t s = 0; s < 4; ++s) {
      const SurfaceSample& sample = bench.buffer.direct[(2 * (i / 40) + s / 2) * 80 + 2 * (i % 40) + s % 2];
      const float share =
          sample.valid ? shader::light_intensity(wide.params(), glm::normalize(sample.position - position)).x
                       : 0.0f;
      least = std::min(least, share), largest = std::max(largest, share);
    }
    const float full = by_omni.pixels[i].x, lit = by_spot.pixels[i].x;
    EXPECT_GE(lit, least * full - 1e-5f * full) << i;
    EXPECT_LE(lit, largest * full + 1e-5f * full) << i;
    partly += least > 0.05f && largest < 0.95f && full > 0.0f;
  }
  EXPECT_GT(partly, 20u);
}

// The reflected direct light of a Lambert view under one omni, in double precision, shadows by single rays.
double reference_norm_and_difference(const TransferBench& bench, const Light& light, const Image& direct,
                                     double& difference) {
  double norm = 0.0, wrong = 0.0;
  const size_t width = static_cast<size_t>(bench.buffer.view.width);
  for (size_t i = 0; i < direct.pixels.size(); ++i) {
    glm::dvec3 sum(0.0);
    for (size_t k = 0; k < 4; ++k) {
      const SurfaceSample& s =
          bench.buffer.direct[(2 * (i / width) + k / 2) * 2 * width + 2 * (i % width) + k % 2];
      if (!s.valid) continue;
      const glm::dvec3 w = glm::dvec3(light.position) - glm::dvec3(s.position);
      const double r2 = glm::dot(w, w), r = std::sqrt(r2);
      const double cosine = glm::dot(glm::dvec3(s.shading_normal), w) / r;
      if (cosine <= 0.0 || glm::dot(glm::dvec3(s.geometric_normal), w) <= 0.0) continue;
      if (!bench.tracer.visible_from_point(s.position, s.geometric_normal, light.position)) continue;
      sum += glm::dvec3(s.diffuse) * glm::dvec3(light.intensity) * (cosine / (r2 * glm::pi<double>()));
    }
    const glm::dvec3 d = 0.25 * sum - glm::dvec3(direct.pixels[i]);
    wrong += glm::dot(d, d), norm += glm::dot(0.25 * sum, 0.25 * sum);
  }
  difference = std::sqrt(wrong);
  return std::sqrt(norm);
}

// 1 / r^2 spans eight orders of magnitude in one picture, and the light's own shadow rays graze the wall. The
// cosine cancels digits: height over distance is exact to 2^-24 x coordinate / height = 3.4e-4. Tried: r for
// r^2 in the light model.
TEST(RelightHardCases, ALightATenThousandthOfTheDiagonalFromAWallIsAsDoublePrecisionSays) {
  TransferBench bench(tiny::room());
  const float height = 1e-4f * bench.scene.bounds.diagonal();
  for (const glm::vec3& position :
       {glm::vec3(0.4f, -1.0f + height, 0.3f), glm::vec3(0.4f, 0.2f, -1.0f + height),
        glm::vec3(-1.0f + height, -1.0f + height, -1.0f + height)}) {
    const Light light = tiny::omni(position, glm::vec3(0.01f));
    const Relit relit = relit_by_both(bench, light);
    double difference = 0.0;
    const double norm = reference_norm_and_difference(bench, light, relit.direct, difference);
    EXPECT_GT(norm, 0.0);
    EXPECT_LE(difference, 3.4e-4 * norm);
  }
}

// Neither an importance map nor a row has anything to stand on. Red if an empty view divides by its number of
// samples.
TEST(RelightHardCases, ACameraThatSeesOnlyBackgroundGivesABlackPicture) {
  for (const char* preset : {"paper", "best"}) {
    TransferBench bench([] {
      Scene scene = tiny::room();
      scene.camera.target = scene.camera.eye + glm::vec3(0.0f, 0.1f, 1.0f);
      finish_scene(scene);
      return scene;
    }());
    for (const SurfaceSample& s : bench.buffer.direct) ASSERT_FALSE(s.valid);
    TransferBench::Knobs knobs = {{"device", "cpu"}};
    for (const KnobPreset& p : bench.method->presets())
      if (p.name == preset) knobs.insert(knobs.end(), p.values.begin(), p.values.end());
    StageLog log;
    const Relit relit = bench.prepare(knobs)->relight(tiny::lighting({tiny::omni({0.3f, 0.6f, 0.4f})}), log);
    EXPECT_EQ(test::norm(relit.total), 0.0) << preset;
    EXPECT_TRUE(log.warnings().empty());
  }
}

// Upsampling takes indirect light from any of the 3x3 pixels.
bool black_around(const DeepFrameBuffer& buffer, size_t pixel) {
  const int w = buffer.view.width, h = buffer.view.height;
  const int x = static_cast<int>(pixel) % w, y = static_cast<int>(pixel) / w;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (x + dx < 0 || x + dx >= w || y + dy < 0 || y + dy >= h) return false;
      const SurfaceSample& s = buffer.indirect[static_cast<size_t>((y + dy) * w + x + dx)];
      if (!s.valid || s.diffuse != glm::vec3(0.0f)) return false;
    }
  return true;
}

// Checks of albedo 1 and 0, four bounces: what is black stays exactly black, nothing grows without bound. The
// room loses light through its open side, so that the series converges. Tried: an albedo of at least 0.01 in
// the product.
TEST(RelightHardCases, ATextureOfAlbedosZeroAndOneStaysFiniteAndBlackWhereItIsBlack) {
  TransferBench bench([] {
    Scene scene = tiny::room();
    Texture checks;
    checks.width = checks.height = 64;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) checks.texels.emplace_back((x / 16 + y / 16) % 2 ? 1.0f : 0.0f);
    scene.textures.push_back(checks);
    for (Material& m : scene.materials) m.diffuse = glm::vec3(1.0f), m.diffuse_texture = 0;
    finish_scene(scene);
    return scene;
  }());
  const LightingState lighting = tiny::lighting({tiny::omni({0.3f, 0.6f, 0.4f})});
  for (const char* kind : {"photons", "transfer"}) {
    StageLog log;
    const Relit relit = bench
                            .prepare({{"device", "cpu"},
                                      {"weights", "float32"},
                                      {"bounces", "4"},
                                      {"multi_bounce", kind},
                                      {"photons", "20000"},
                                      {"photon_neighbours", "50"}})
                            ->relight(lighting, log);
    ASSERT_TRUE(all_finite(relit.total)) << kind;
    // A closed room of this light would hold less than the light itself at each of its bounces.
    EXPECT_LT(test::norm(relit.indirect), 4.0 * test::norm(relit.direct));
    size_t black = 0;
    for (size_t i = 0; i < relit.indirect.pixels.size(); ++i) {
      if (!black_around(bench.buffer, i)) continue;
      ++black;
      EXPECT_EQ(relit.indirect.pixels[i], glm::vec3(0.0f)) << i;
    }
    EXPECT_GT(black, 30u);
  }
}

}  // namespace
}  // namespace relight
