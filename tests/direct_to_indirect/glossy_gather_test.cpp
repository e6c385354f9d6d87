// Rows of the glossy final-gather matrix against brute force in double precision, for each reflection model
// with a wide and a sharp lobe; by links and by rays.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <gtest/gtest.h>

#include "common/run/thread_limit.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/column_scaling.h"
#include "tests/direct_to_indirect/gather_oracle.h"
#include "tests/direct_to_indirect/glossy_oracle.h"
#include "tests/support/tiny_scenes.h"

namespace relight::direct_to_indirect {
namespace {

FinalGatherSettings exact_glossy(int coefficients) {
  FinalGatherSettings settings = exact_settings(coefficients);
  settings.glossy_coefficients = coefficients;
  return settings;
}

// Single-sample links, nothing truncated. Float F and Haar: 2e-5 as for the diffuse rows; a lobe of exponent
// e magnifies the rounding of a cosine, 3e-7, by e. Rows for glossy pixels only, and those of their
// neighbours in the tile are not mixed up. Tried, each red: without pi; the lobe of lane 1
// for all; elements bounded by 1 instead of the lobe's albedo.
TEST(GlossyGather, UntruncatedRowsEqualTheBruteForceOracleForEachModelWideAndSharp) {
  for (const LobeCase& c : lobe_cases()) {
    GatherSetup s(tiny::room(), 20, 15, 1024, true);
    make_glossy(s.buffer, c.part, 3);
    const FinalGather matrix = gather_glossy(s, exact_glossy(1024)).matrix;
    ASSERT_EQ(matrix.glossy_pixels, glossy_pixels(s.buffer));
    ASSERT_EQ(matrix.glossy.rows(), matrix.glossy_pixels.size());
    double worst = 0.0;
    size_t lit = 0;
    for (size_t r = 0; r < matrix.glossy.rows(); r += 3) {
      const uint32_t pixel = matrix.glossy_pixels[r];
      EXPECT_NE(pixel % 3, 0u);
      const std::vector<double> expected = glossy_oracle_row(s, c.part, s.buffer.indirect[pixel]);
      const std::vector<double> got = wavelet::inverse(dense_row(matrix.glossy, r));
      const double largest = *std::max_element(expected.begin(), expected.end());
      lit += largest > 1e-3;
      for (size_t j = 0; j < got.size(); ++j) {
        const double difference = std::abs(got[j] - expected[j]) / std::max(largest, 1e-3);
        worst = std::isfinite(difference) ? std::max(worst, difference) : INFINITY;
      }
    }
    EXPECT_GT(lit, 10u) << c.name;
    EXPECT_LT(worst, 2e-5 + 3e-7 * c.sharpness) << c.name;
  }
}

// One visibility ray serves both matrices: with every link to a single sample, the diffuse rows and the
// number of rays are those of a gather without gloss. Red if a lobe's link is traced again or changes F_d
// (tried: rays counted for each matrix).
TEST(GlossyGather, SharesItsRaysWithTheDiffuseMatrix) {
  GatherSetup s(tiny::room(), 20, 15, 1024, true);
  make_glossy(s.buffer, phong_part(glm::vec3(0.3f), 50.0f), 3);
  const FinalGatherSettings settings = exact_glossy(1024);
  const GlossyRun run = gather_glossy(s, settings);
  Progress quiet(true);
  StageLog log;
  const TrainingLights none;
  const FinalGather plain =
      compute_final_gather({s.tracer, s.buffer, s.cloud, s.hierarchy, {}, none}, settings, quiet, log);
  EXPECT_EQ(run.log.counters().at("visibility_rays"), log.counters().at("visibility_rays"));
  ASSERT_EQ(run.matrix.diffuse.entries.size(), plain.diffuse.entries.size());
  EXPECT_EQ(std::memcmp(run.matrix.diffuse.entries.data(), plain.diffuse.entries.data(),
                        plain.diffuse.entries.size() * sizeof(SparseEntry)),
            0);
}

// Light that varies smoothly over the room, in wavelet space.
std::vector<double> smooth_light(const GatherSetup& s) {
  std::vector<double> g;
  for (const SurfaceSample& sample : s.cloud.samples)
    g.push_back(1.5 + std::sin(3.0 * double(sample.position.x)) * std::cos(2.0 * double(sample.position.y)));
  return wavelet::forward(g);
}

std::vector<double> answers(const SparseRows& rows, const std::vector<double>& g) {
  std::vector<double> out;
  for (size_t r = 0; r < rows.rows(); ++r) {
    double sum = 0.0;
    for (const SparseEntry& e : rows.row(r)) sum += static_cast<double>(e.value) * g[e.column];
    out.push_back(sum);
  }
  return out;
}

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double d2 = 0.0, n2 = 0.0;
  for (size_t i = 0; i < a.size(); ++i) d2 += (a[i] - b[i]) * (a[i] - b[i]), n2 += b[i] * b[i];
  return std::sqrt(d2 / n2);
}

// The heuristic with the lobe in it (section 4.3): links to clusters answer a smooth light as links to all
// samples do, for lobes that several cells fill, with a random member's element or the cluster's mean. Red
// without the lobe in the heuristic (tried: 0.10 to 0.15), or with a mean that counts all areas (tried).
TEST(GlossyGather, SubdividesWhereTheLobeIsLarge) {
  const glm::vec3 gold(0.9f, 0.6f, 0.25f);
  for (const GlossyPart& part :
       {phong_part(gold, 60.0f), ashikhmin_shirley_part(gold, 60.0f, 60.0f), ggx_part(gold, 0.15f, 0.15f)}) {
    GatherSetup s(tiny::room(), 16, 12, 4096, true);
    make_glossy(s.buffer, part, 5);
    FinalGatherSettings settings = exact_glossy(4096);
    const FinalGather exact = gather_glossy(s, settings).matrix;
    settings.link_threshold = 0.1f;
    const std::vector<double> g = smooth_light(s);
    for (const bool mean_elements : {false, true}) {
      settings.mean_elements = mean_elements;
      const FinalGather linked = gather_glossy(s, settings).matrix;
      const double difference = relative_difference(answers(linked.glossy, g), answers(exact.glossy, g));
      std::printf("model %d: %.4f\n", static_cast<int>(part.model()), difference);
      EXPECT_LT(difference, 0.05) << mean_elements;
    }
  }
}

// The closed unit box, seen from within.
Scene furnace() {
  Scene scene = tiny::empty_scene();
  tiny::add_box(scene, {0, 0, 0}, {1, 1, 1});
  scene.camera.eye = {0.9f, 0.55f, 0.4f}, scene.camera.target = {0, 0.2f, 0.1f};
  finish_scene(scene);
  return scene;
}

// Integral of rho_g cos over the hemisphere by the midpoint rule about the mirror direction: rings of equal
// steps in the logarithm of the angle, so that narrow lobes are resolved too.
double lobe_albedo(const GlossyPart& part, const SurfaceSample& v, const glm::dvec3& eye) {
  constexpr int rings = 200, sectors = 60;
  constexpr double pi = std::numbers::pi, smallest = 1e-5;
  const glm::dvec3 n(v.shading_normal), wo = glm::normalize(eye - glm::dvec3(v.position));
  const glm::dvec3 mirror = 2.0 * glm::dot(n, wo) * n - wo;
  const glm::dvec3 t = glm::normalize(std::abs(mirror.x) > 0.5 ? glm::cross(mirror, glm::dvec3(0, 1, 0))
                                                               : glm::cross(mirror, glm::dvec3(1, 0, 0)));
  const glm::dvec3 b = glm::cross(mirror, t);
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double lo = smallest * std::pow(pi / smallest, double(i) / rings),
                 hi = smallest * std::pow(pi / smallest, double(i + 1) / rings);
    const double angle = 0.5 * (lo + hi), solid_angle = 2.0 * pi * (std::cos(lo) - std::cos(hi)) / sectors;
    for (int k = 0; k < sectors; ++k) {
      const double phi = 2.0 * pi * (k + 0.5) / sectors;
      const glm::dvec3 wi =
          std::cos(angle) * mirror + std::sin(angle) * (std::cos(phi) * t + std::sin(phi) * b);
      const double cosine = glm::dot(n, wi);
      if (cosine > 0.0) sum += rho(part, v, eye, wi) * cosine * solid_angle;
    }
  }
  return sum;
}

// White furnace: in a closed box of radiance 1 a row answers its lobe's albedo, whatever the lobe's width. By
// rays within 1 % on average; by links within 5 % for lobes that several cells fill. No row answers more than
// its lobe could by more than the noise of its rays. Red if a ray's weight lacks
// its cosine (tried).
TEST(GlossyGather, RowsOfAClosedBoxSumToTheLobesAlbedo) {
  for (const LobeCase& c : lobe_cases()) {
    GatherSetup s(furnace(), 8, 8, 4096, true);
    make_glossy(s.buffer, c.part, 1000);
    const GlossyRays rays(s.tracer, s.cloud, 256, 1);
    const std::vector<double> by_rays = answers(gather_glossy(s, exact_glossy(4096), &rays).matrix.glossy,
                                                wavelet::forward(std::vector<double>(4096, 1.0)));
    const FinalGather links = gather_glossy(s, exact_glossy(4096)).matrix;
    const std::vector<double> by_links =
        answers(links.glossy, wavelet::forward(std::vector<double>(4096, 1.0)));
    double ray_sum = 0.0, link_sum = 0.0, albedo_sum = 0.0, excess = 0.0;
    for (size_t r = 0; r < by_rays.size(); ++r) {
      const double albedo = lobe_albedo(c.part, s.buffer.indirect[links.glossy_pixels[r]],
                                        glm::dvec3(s.buffer.view.camera.eye));
      ray_sum += by_rays[r], link_sum += by_links[r], albedo_sum += albedo;
      excess = std::max(excess, by_rays[r] - albedo);
    }
    std::printf("%s: rays %.4f links %.4f largest excess %.4f\n", c.name.c_str(), ray_sum / albedo_sum,
                link_sum / albedo_sum, excess);
    EXPECT_NEAR(ray_sum / albedo_sum, 1.0, 0.01) << c.name;
    EXPECT_LT(excess, 0.03) << c.name;
    if (c.sharpness < 1e3) {
      EXPECT_NEAR(link_sum / albedo_sum, 1.0, 0.05) << c.name;
    }
  }
}

// Both ways estimate the same matrix: for a wide lobe, answers to smooth light agree. The median, because
// links of pixels close to a corner are far off (near_field.h). Measured: 0.6 %. Red if one of them forgets
// the column's scale (tried: rays not divided by it).
TEST(GlossyGather, RaysAndLinksAgreeOnAWideLobeWithColumnScalingToo) {
  GatherSetup s(tiny::room(), 12, 8, 4096, true);
  make_glossy(s.buffer, phong_part(glm::vec3(0.3f), 5.0f), 5);
  const FinalGatherSettings settings = exact_glossy(4096);
  const std::vector<float> scale = mean_row_scaling(s.tracer, s.buffer, s.cloud, s.hierarchy, settings);
  const GlossyRays rays(s.tracer, s.cloud, 1024, 1);
  const std::vector<double> by_links =
      answers(gather_glossy(s, settings, nullptr, {}).matrix.glossy, smooth_light(s));
  std::vector<double> scaled = wavelet::inverse(smooth_light(s));
  for (size_t j = 0; j < scaled.size(); ++j) scaled[j] *= static_cast<double>(scale[j]);
  const std::vector<double> by_rays =
      answers(gather_glossy(s, settings, &rays, scale).matrix.glossy, wavelet::forward(scaled));
  std::vector<double> differences;
  for (size_t i = 0; i < by_rays.size(); ++i) differences.push_back(std::abs(by_rays[i] / by_links[i] - 1.0));
  std::nth_element(differences.begin(), differences.begin() + 30, differences.end());
  EXPECT_GT(differences.size(), 60u);
  EXPECT_LT(differences[30], 0.015);
}

// Red if random numbers depend on the thread, or scratch leaks from tile to tile.
TEST(GlossyGather, HasTheSameBitsForOneAndTwoThreads) {
  GatherSetup s(tiny::room(), 24, 20, 1024, true);
  make_glossy(s.buffer, ggx_part(glm::vec3(0.5f), 0.1f, 0.1f), 4);
  const GlossyRays rays(s.tracer, s.cloud, 64, 1);
  for (const GlossyRays* by : {static_cast<const GlossyRays*>(nullptr), &rays}) {
    std::vector<SparseRows> rows;
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      rows.push_back(gather_glossy(s, {}, by).matrix.glossy);
    }
    ASSERT_GT(rows[0].entries.size(), 1000u);
    ASSERT_EQ(rows[0].entries.size(), rows[1].entries.size());
    EXPECT_EQ(std::memcmp(rows[0].entries.data(), rows[1].entries.data(),
                          rows[0].entries.size() * sizeof(SparseEntry)),
              0);
  }
}

// Red if the glossy matrix takes the diffuse budget.
TEST(GlossyGather, KeepsItsOwnNumberOfCoefficients) {
  GatherSetup s(tiny::room(), 16, 12, 1024, true);
  make_glossy(s.buffer, phong_part(glm::vec3(0.3f), 20.0f), 4);
  FinalGatherSettings settings;
  settings.coefficients = 40, settings.glossy_coefficients = 15;
  const FinalGather matrix = gather_glossy(s, settings).matrix;
  size_t most = 0;
  for (size_t r = 0; r < matrix.glossy.rows(); ++r) most = std::max(most, matrix.glossy.row(r).size());
  EXPECT_EQ(most, 15u);
  most = 0;
  for (size_t r = 0; r < matrix.diffuse.rows(); ++r) most = std::max(most, matrix.diffuse.row(r).size());
  EXPECT_EQ(most, 40u);
}

}  // namespace
}  // namespace relight::direct_to_indirect
