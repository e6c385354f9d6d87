// Surfaces that are hard to stand on: edges where walls meet, areas that differ by twelve orders of
// magnitude, a room that keeps nearly all of its light.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/hard_cases/image_difference.h"
#include "common/hard_cases/tiny_scenes.h"
#include "common/sampling/random.h"
#include "methods/direct_to_indirect/hard_cases/bench.h"
#include "methods/direct_to_indirect/hard_cases/gather_oracle.h"
#include "methods/direct_to_indirect/hard_cases/hard_cases.h"

namespace relight::direct_to_indirect {

namespace {

using namespace hard;

constexpr int64_t samples = 1024;

Scene closed_box(float albedo) {
  Scene scene = tiny::empty_scene(glm::vec3(albedo));
  tiny::add_box(scene, glm::vec3(-1.0f), glm::vec3(1.0f));
  scene.camera.eye = {0.3f, 0.2f, 0.6f}, scene.camera.target = {0.0f, -0.1f, -1.0f};
  finish_scene(scene);
  return scene;
}

// Points on the floor a hundredth to a tenth of the room from the edges where it meets two walls.
void stand_in_corners(GatherSetup& s) {
  for (size_t i = 0; i < s.buffer.indirect.size(); ++i) {
    const glm::vec2 u(random_float(7, 1, i, 0), random_float(7, 1, i, 1));
    SurfaceSample& v = s.buffer.indirect[i];
    v.position = {-1.0f + 0.02f + 0.18f * u.x, -1.0f, -1.0f + 0.02f + 0.18f * u.y};
    v.shading_normal = v.geometric_normal = {0, 1, 0};
    v.valid = true;
  }
}

// A closed room surrounds every point: each row sums to one, exactly.
std::vector<double> row_sums(GatherSetup& s, const NearField* near_field) {
  FinalGatherSettings settings = exact_settings(samples);
  settings.form_factor_clamp = 0.1f;
  const SparseRows rows = s.final_gather(settings, {}, {}, near_field);
  std::vector<double> sums;
  for (size_t i = 0; i < rows.rows(); ++i)
    sums.push_back(dense_row(rows, i)[0] * std::sqrt(static_cast<double>(samples)));
  return sums;
}

Figures concave_corners() {
  GatherSetup s(closed_box(0.5f), 16, 16, samples, true);
  stand_in_corners(s);
  const NearField near(s.tracer, s.cloud, s.hierarchy, {});
  const std::vector<double> clamped = row_sums(s, nullptr), rays = row_sums(s, &near);
  const auto mean = [](const std::vector<double>& sums) {
    return std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(sums.size());
  };
  double worst = 0.0;
  for (const double sum : rays) worst = std::max(worst, std::abs(sum - 1.0));
  return {
      at_most("mean row sum with hemisphere rays, off one", std::abs(mean(rays) - 1.0), 0.03,
              "what stands for itself beyond the near field is a sample in the middle of its cell"),
      at_most("a row sum with hemisphere rays, off one", worst, 0.25,
              "256 rays: a share of a half is known to 0.03, five deviations are 0.16; the rest is cells"),
      at_most("mean row sum with the paper's clamp", mean(clamped), 1.05,
              "a clamp takes light away and gives none"),
      at_most("the same, from below: one less it", 1.0 - mean(clamped), 0.6,
              "stated: how dark the paper's clamp makes corners"),
      at_least("what the clamp takes away", 1.0 - mean(clamped), 0.05, "else these points are in no corner")};
}

// Floor and ceiling, and a speck beside them whose area is a millionth of a millionth of theirs.
Figures areas_apart() {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  tiny::add_quad(scene, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
  tiny::add_quad(scene, {3, 0.5f, 0}, {0, 0, 2e-6f}, {2e-6f, 0, 0});
  scene.camera.eye = {0.1f, 0.4f, 1.5f}, scene.camera.target = {0, 0.2f, 0};
  finish_scene(scene);
  GatherSetup s(std::move(scene), 8, 8, samples, true);
  FinalGatherSettings settings = exact_settings(samples);
  settings.form_factor_clamp = 0.1f;
  double of_speck = 0.0, area = 0.0;
  for (size_t j = 0; j < s.cloud.samples.size(); ++j) {
    const double a = static_cast<double>(s.cloud.area[j]);
    if (s.cloud.samples[j].position.x > 2.0f)
      of_speck += a;
    else
      area += a;
  }
  return {
      at_most("element of a row, from the pair-by-pair oracle in double", worst_difference(s, settings, 0.1),
              2e-5, "float geometry, Haar transform and back: some hundred roundings of 2^-24"),
      at_most("area that samples of floor and ceiling stand for, off 16, both sides counted",
              std::abs(area - 16.0), 16.0 * 2e-3,
              "floats; a part of two samples of 1,024 may stand for the speck"),
      at_most("area that samples of the speck stand for", of_speck, 2.0 * 4e-12 * 1.01,
              "both sides of the speck, and no more")};
}

// Four bounces in a room that keeps 95 % of its light at each: 0.95^4 of all light comes later.
Figures closed_box_of_albedo_095() {
  MethodBench bench = transfer_bench(closed_box(0.95f));
  Figures figures;
  for (const char* kind : {"photons", "transfer"}) {
    const Relit relit = bench.relight(four_bounces(kind), tiny::lighting({tiny::omni({0.1f, 0.2f, 0.0f})}));
    add_worst(figures, non_finite_pixels({&relit.total}));
    const auto& counters = bench.precompute_log.counters();
    const auto found = counters.find("bounce_energy_beyond_ppm");
    const double beyond = found == counters.end() ? NAN : 1e-6 * static_cast<double>(found->second);
    add_worst(figures, at_most("share of light beyond four bounces, reported, above 0.95^4",
                               beyond - std::pow(0.95, 4), 0.01, "no bounce keeps more than 95 %"));
    add_worst(figures,
              at_least("share of light beyond four bounces, reported", beyond, std::pow(0.95 * 0.9, 4),
                       "edges of the room lose up to a tenth of each bounce: clamped elements, and "
                       "photon discs that hang over them"));
    add_worst(figures,
              at_least("warnings that say so", static_cast<double>(bench.precompute_log.warnings().size()),
                       1.0, "the picture lacks most of its light"));
    const double ratio = norm(relit.indirect) / norm(relit.direct);
    add_worst(figures,
              at_most("indirect over direct light", ratio, 4.0, "each bounce brings less than the last"));
    add_worst(figures, at_least("indirect over direct light, at least", ratio, 1.0,
                                "0.95 + 0.9 + 0.86 + 0.81 of it, spread more evenly; corners lose some"));
  }
  return figures;
}

}  // namespace

Cases surface_cases() {
  return {
      {"concave corners", "1/r^2 between walls that meet: too much light, or with a clamp too little.",
       concave_corners},
      {"areas twelve orders of magnitude apart",
       "A budget of no samples, or of all; an area lost to rounding.", areas_apart},
      {"a closed box of albedo 0.95", "Bounces that are left out hold most of the light, and nobody is told.",
       closed_box_of_albedo_095}};
}

}  // namespace relight::direct_to_indirect
