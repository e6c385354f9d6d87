// Environments at which truncated wavelets, or a view, could go wrong.
#include <algorithm>
#include <cmath>

#include "common/hard_cases/image_difference.h"
#include "common/hard_cases/tiny_scenes.h"
#include "common/hard_cases/tiny_skies.h"
#include "methods/direct_to_indirect/hard_cases/bench.h"
#include "methods/direct_to_indirect/hard_cases/hard_cases.h"

namespace relight::direct_to_indirect {

namespace {

using namespace hard;

Relit relit(MethodBench& bench, KnobList knobs) {
  knobs.insert(knobs.begin(), {{"device", "cpu"}, {"weights", "float32"}});
  return bench.relight(knobs, tiny::lighting({}));
}

MethodBench bench_in(Environment environment, bool turned_away = false) {
  Scene scene = tiny::room();
  if (turned_away) scene.camera.target = scene.camera.eye + glm::vec3(0.0f, 0.1f, 1.0f);
  scene.environment = std::move(environment);
  finish_scene(scene);
  return transfer_bench(std::move(scene));
}

// A sun of one map texel with radiance 1e5 in a sky of 1: of the irradiance on a floor, 55 %. Rows of 100 of
// 4096 coefficients know where the sky is, but not to the texel: where the sun should be hidden some of it
// leaks, and Haar's rings may even be negative (docs/environment.md).
Figures sun_of_one_texel() {
  Environment sky = tiny::black_map(256, 128);
  for (glm::vec3& t : sky.texels) t = glm::vec3(1.0f);
  sky.texels[256 * 40 + 120] = glm::vec3(1e5f);
  MethodBench bench = bench_in(std::move(sky));
  ArtefactCache clouds = ArtefactCache::in_memory();
  bench.parts = &clouds;
  const Relit kept = relit(bench, {}), all = relit(bench, {{"environment_coefficients", "0"}});
  double lowest = 0.0, highest = 0.0, least_of_all = 0.0, sum = 0.0, sum_all = 0.0;
  for (size_t i = 0; i < kept.direct.pixels.size(); ++i) {
    const auto k = static_cast<double>(kept.direct.pixels[i].x),
               a = static_cast<double>(all.direct.pixels[i].x);
    lowest = std::min(lowest, k), highest = std::max(highest, a), sum += k, sum_all += a;
    least_of_all = std::min(least_of_all, a);
  }
  return {
      non_finite_pixels({&kept.total, &all.total}),
      at_least("least light, 100 coefficients, over the brightest pixel", lowest / highest, -0.02,
               "stated: a negative pixel that is not seen"),
      at_most("sum of the picture against all coefficients", std::abs(sum / sum_all - 1.0), 0.03,
              "stated: truncation moves light, it neither makes nor loses more"),
      at_least("least light, all coefficients", least_of_all, 0.0, "sums of products of positive numbers"),
      at_most("warnings", static_cast<double>(bench.relight_log.warnings().size()), 0.0,
              "a value that was replaced is told by a warning")};
}

// The background is the environment itself, box-filtered like everything else.
Figures view_of_the_environment_alone() {
  MethodBench bench = bench_in(tiny::uneven_map(64, 32, 0.6f), true);
  double worst = 0.0;
  for (const char* device : {"cpu", "gpu", "oracle"}) {
    const Relit found = relit(bench, {{"device", device}});
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x) {
        glm::dvec3 truth(0.0);
        for (int s = 0; s < 4; ++s)
          truth += 0.25 * glm::dvec3(bench.scene.environment.lookup(
                              bench.buffer.eye_direction(2 * x + s % 2, 2 * y + s / 2)));
        const glm::dvec3 d = glm::abs(glm::dvec3(found.total.at(x, y)) - truth) / glm::max(truth, 1e-30);
        if (const double largest = std::max({d.x, d.y, d.z}); !(largest <= worst)) worst = largest;
      }
  }
  return {at_most("relative difference of a pixel from the mean of its four directions", worst, 1e-6,
                  "rounding; half a pixel, or another order of the sub-pixels, would be per cents")};
}

// A map that is black everywhere is no black environment by its multiplier: everything is computed, and
// black.
Figures black_map() {
  MethodBench bench = bench_in(tiny::black_map(8, 4));
  return {
      at_most("light of the picture", norm(relit(bench, {}).total), 0.0, "sums of zeros"),
      at_most("warnings", static_cast<double>(bench.relight_log.warnings().size()), 0.0, "nothing is wrong")};
}

}  // namespace

Cases environment_cases() {
  return {{"a sun of one texel in a dim sky", "Truncated wavelets ring, and leak behind walls.",
           sun_of_one_texel},
          {"a view of the environment alone", "Directions off by half a pixel; no view sample to stand on.",
           view_of_the_environment_alone},
          {"a black environment map", "Division by a map's energy of zero.", black_map}};
}

}  // namespace relight::direct_to_indirect
