// Lobes at the limits of what scene files accept and eyes that graze the surface. Stated bound for all of
// them: every coefficient finite; no row answers even light with more than its lobe's albedo, within the
// noise of its rays.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/direct_to_indirect/glossy_oracle.h"
#include "tests/support/tiny_scenes.h"
#include "tests/support/transfer_bench.h"

namespace relight::direct_to_indirect {
namespace {

std::vector<GlossyPart> extreme_parts() {
  const glm::vec3 coat(0.04f), gold(0.9f, 0.6f, 0.25f);
  return {phong_part(gold, 1e4f),
          phong_part(gold, largest_exponent),
          phong_part(gold, 0.0f),
          ashikhmin_shirley_part(coat, largest_exponent, largest_exponent),
          ashikhmin_shirley_part(gold, 10.0f, largest_exponent),
          ashikhmin_shirley_part(coat, 0.0f, 0.0f),
          ggx_part(gold, smallest_alpha, smallest_alpha),
          ggx_part(coat, 1.0f, smallest_alpha)};
}

// A camera in the tiny room whose distance above the floor is `height`, looking along it.
Scene grazing(float height) {
  Scene scene = tiny::room();
  scene.camera.eye = {0.6f, -1.0f + height, 0.95f},
  scene.camera.target = {0.55f, -1.0f + 0.9f * height, -0.9f};
  finish_scene(scene);
  return scene;
}

// Sum of each row's elements: the scaling coefficient times the root of the number of columns.
std::vector<double> row_sums(const SparseRows& rows) {
  std::vector<double> sums;
  for (size_t r = 0; r < rows.rows(); ++r) {
    double sum = 0.0;
    for (const SparseEntry& e : rows.row(r)) {
      EXPECT_TRUE(std::isfinite(e.value)) << r << ' ' << e.column;
      if (e.column == 0) sum = static_cast<double>(e.value) * std::sqrt(static_cast<double>(rows.columns));
    }
    sums.push_back(sum);
  }
  return sums;
}

// Red if a density of 0 or infinity or a half vector of length 0 gets through, or the weight of a ray lacks
// its cosine (tried).
TEST(GlossyHardCases, ExtremeLobesAtGrazingEyesGiveFiniteRowsOfNoMoreThanTheirAlbedo) {
  for (const float height : {0.3f, 1e-2f, 1e-4f}) {
    GatherSetup s(grazing(height), 16, 12, 1024, true);
    for (const GlossyPart& part : extreme_parts()) {
      make_glossy(s.buffer, part, 1000);
      FinalGatherSettings settings = exact_settings(1024);
      settings.glossy_coefficients = 1024;
      const GlossyRays rays(s.tracer, s.cloud, 64, 1);
      const FinalGather by_rays = gather_glossy(s, settings, &rays).matrix,
                        by_links = gather_glossy(s, settings).matrix;
      row_sums(by_links.glossy);
      const std::vector<double> sums = row_sums(by_rays.glossy);
      ASSERT_GT(sums.size(), 90u);
      for (size_t r = 0; r < sums.size(); ++r) {
        // A row of energy k_g x sum reflects no more than arrives.
        const glm::vec3 f0 = part.glossy;
        EXPECT_LT(sums[r] * double(f0.x + f0.y + f0.z) / 3.0, 1.05) << r;
        EXPECT_GE(sums[r], -1e-6) << r;
      }
    }
  }
}

// The whole way to pixels, by both devices. Bound as in relight_test.cpp, twice because there are two
// matrices.
TEST(GlossyHardCases, AMirrorLikeFloorAtAGrazingEyeIsFiniteAndAgreesOnBothDevices) {
  Scene scene = grazing(1e-2f);
  scene.materials[0].set_glossy_part(phong_part(glm::vec3(0.3f), 1e4f));
  test::TransferBench bench(std::move(scene));
  const LightingState lighting = tiny::lighting({tiny::omni({-0.3f, 0.6f, 0.7f})});
  StageLog log;
  const Relit cpu = bench.prepare({{"device", "cpu"}, {"weights", "float32"}, {"glossy_gather", "rays"}})
                        ->relight(lighting, log);
  const Relit oracle =
      bench.prepare({{"device", "oracle"}, {"shadows", "traced"}, {"glossy_gather", "rays"}})
          ->relight(lighting, log);
  for (const glm::vec3& p : cpu.total.pixels) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
  EXPECT_TRUE(log.warnings().empty());
  EXPECT_GT(test::norm(oracle.indirect), 0.0);
  EXPECT_LT(test::relative_difference(cpu.indirect, oracle.indirect), 1.2e-5);
}

}  // namespace
}  // namespace relight::direct_to_indirect
