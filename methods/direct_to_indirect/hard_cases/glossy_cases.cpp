// Lobes at the limits of what scene files accept, and eyes that graze the surface.
#include <cmath>

#include "common/brdf/brdf_lobes.h"
#include "common/hard_cases/image_difference.h"
#include "common/hard_cases/tiny_scenes.h"
#include "methods/direct_to_indirect/hard_cases/bench.h"
#include "methods/direct_to_indirect/hard_cases/glossy_setup.h"
#include "methods/direct_to_indirect/hard_cases/hard_cases.h"

namespace relight::direct_to_indirect {

namespace {

using namespace hard;

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

struct RowSums {
  std::vector<double> sums;  // of each row's elements: the scaling coefficient times the root of the columns
  double not_finite = 0.0;
  explicit RowSums(const SparseRows& rows) {
    for (size_t r = 0; r < rows.rows(); ++r) {
      double sum = 0.0;
      for (const SparseEntry& e : rows.row(r)) {
        if (!std::isfinite(e.value)) ++not_finite;
        if (e.column == 0) sum = static_cast<double>(e.value) * std::sqrt(static_cast<double>(rows.columns));
      }
      sums.push_back(sum);
    }
  }
};

Figures extreme_lobes(GatherSetup& s, const GlossyPart& part) {
  make_glossy(s.buffer, part, 1000);
  FinalGatherSettings settings = exact_settings(1024);
  settings.glossy_coefficients = 1024;
  const GlossyRays rays(s.tracer, s.cloud, 64, 1);
  const RowSums by_rays(gather_glossy(s, settings, &rays).matrix.glossy),
      by_links(gather_glossy(s, settings).matrix.glossy);
  double most = 0.0, least = 0.0;
  for (const double sum : by_rays.sums) {
    // A row of energy k_g x sum reflects no more than arrives.
    most = std::max(most, sum * double(part.glossy.x + part.glossy.y + part.glossy.z) / 3.0);
    least = std::min(least, sum);
  }
  return {at_most("coefficients that are not finite", by_rays.not_finite + by_links.not_finite, 0.0,
                  "a density of 0 or infinity, or a half vector of length 0, got through"),
          at_most("largest share of even light that a lobe reflects", most, 1.05,
                  "no more than arrives, and the noise of 64 rays"),
          at_least("least row sum", least, -1e-6, "a share; rounding"),
          at_least("glossy rows", static_cast<double>(by_rays.sums.size()), 90.0,
                   "else the view shows no gloss")};
}

Figures extreme_lobes_at_grazing_eyes() {
  Figures figures;
  for (const float height : {0.3f, 1e-2f, 1e-4f}) {
    GatherSetup s(grazing(height), 16, 12, 1024, true);
    for (const GlossyPart& part : extreme_parts()) add_worst(figures, extreme_lobes(s, part));
  }
  return figures;
}

// The whole way to pixels, by both devices.
Figures mirror_like_floor() {
  Scene scene = grazing(1e-2f);
  scene.materials[0].set_glossy_part(phong_part(glm::vec3(0.3f), 1e4f));
  MethodBench bench = transfer_bench(std::move(scene));
  const LightingState lighting = tiny::lighting({tiny::omni({-0.3f, 0.6f, 0.7f})});
  const Relit cpu =
      bench.relight({{"device", "cpu"}, {"weights", "float32"}, {"glossy_gather", "rays"}}, lighting);
  double warnings = static_cast<double>(bench.relight_log.warnings().size());
  const Relit oracle =
      bench.relight({{"device", "oracle"}, {"shadows", "traced"}, {"glossy_gather", "rays"}}, lighting);
  warnings += static_cast<double>(bench.relight_log.warnings().size());
  return {non_finite_pixels({&cpu.total, &oracle.total}),
          at_most("warnings", warnings, 0.0, "a value that was replaced is told by a warning"),
          at_most("indirect light, float against double", relative_difference(cpu.indirect, oracle.indirect),
                  1.2e-5, "twice 100 roundings of 2^-24: there are two matrices"),
          at_least("indirect light", norm(oracle.indirect), 1e-9, "else there is nothing to compare")};
}

}  // namespace

Cases glossy_cases() {
  return {{"extreme lobes at grazing eyes", "Densities of 0 and infinity; half vectors of length 0.",
           extreme_lobes_at_grazing_eyes},
          {"a mirror-like floor at a grazing eye", "A lobe so narrow that float directions blur it.",
           mirror_like_floor}};
}

}  // namespace relight::direct_to_indirect
