// Clouds and views that break sorting, normalising or dividing.
#include <algorithm>
#include <cmath>

#include "common/hard_cases/tiny_scenes.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/hard_cases/gather_oracle.h"
#include "methods/direct_to_indirect/hard_cases/hard_cases.h"

namespace relight::direct_to_indirect {

namespace {

using namespace hard;

constexpr int64_t samples = 256;

Figure links_as_the_oracle(GatherSetup& s) {
  FinalGatherSettings settings = exact_settings(samples);
  settings.form_factor_clamp = 0.1f;
  return at_most("element of a row, from the pair-by-pair oracle in double",
                 worst_difference(s, settings, 0.1), 2e-5,
                 "float geometry, Haar transform and back: some hundred roundings of 2^-24");
}

struct RowSums {
  double bad = 0.0, least = 0.0;  // elements that are not finite, and the least of the others
  double most = 0.0, all = 0.0;   // largest sum of a row, and of all rows
};

// Of untruncated rows.
RowSums row_sums(const SparseRows& rows) {
  RowSums out;
  for (size_t i = 0; i < rows.rows(); ++i) {
    double sum = 0.0;
    for (const double f : wavelet::inverse(dense_row(rows, i))) {
      if (!std::isfinite(f)) ++out.bad;
      out.least = std::min(out.least, f);
      sum += f;
    }
    out.most = std::max(out.most, sum), out.all += sum;
  }
  return out;
}

Figures sane_elements(const RowSums& sums) {
  return {at_most("elements that are not finite", sums.bad, 0.0, "0/0 or overflow"),
          at_least("least element", sums.least, -1e-5, "a share of the hemisphere; float Haar and back")};
}

// Hemisphere rays for what is near.
Figures sane_hemispheres(GatherSetup& s) {
  const NearField near(s.tracer, s.cloud, s.hierarchy, {});
  const RowSums sums = row_sums(s.final_gather(exact_settings(samples), {}, {}, &near));
  Figures figures = sane_elements(sums);
  add_worst(figures, at_most("largest share of the hemisphere that a row receives", sums.most, 1.1,
                             "one, and what 256 rays and the areas of the cells are wrong by"));
  add_worst(figures, at_least("largest share of the hemisphere that a row receives", sums.most, 0.1,
                              "else the view gathers nothing, and every other bound holds"));
  return figures;
}

// Whole clusters by their mean element, against all pairs.
Figures sane_mean_links(GatherSetup& s) {
  FinalGatherSettings settings = exact_settings(samples);
  settings.form_factor_clamp = 0.1f;
  const double exact = row_sums(s.final_gather(settings)).all;
  settings.link_threshold = 0.1f;
  settings.mean_elements = true;
  const RowSums sums = row_sums(s.final_gather(settings));
  Figures figures = sane_elements(sums);
  const char* why = "clusters of a third of their distance: 1/r^2 is within a factor of two of the centre's";
  add_worst(figures,
            at_least("sum of all rows by mean elements, over that of all pairs", sums.all / exact, 0.5, why));
  add_worst(figures,
            at_most("sum of all rows by mean elements, over that of all pairs", sums.all / exact, 2.0, why));
  return figures;
}

Figures sane_rows(GatherSetup& s) {
  Figures figures = {links_as_the_oracle(s)};
  add_worst(figures, sane_hemispheres(s));
  add_worst(figures, sane_mean_links(s));
  return figures;
}

void rebuild(GatherSetup& s) {
  order_gather_cloud(s.cloud, 30.0f, s.scene.bounds.diagonal());
  s.hierarchy = build_hierarchy(s.cloud);
}

// r = 0: the element of a sample to itself is zero, not 0/0.
Figures samples_coincide_with_the_view() {
  GatherSetup s(tiny::room(), 16, 16, samples, true);
  for (size_t i = 0; i < samples; ++i) s.buffer.indirect[i] = s.cloud.samples[i];
  return sane_rows(s);
}

Figures all_samples_coincide() {
  GatherSetup s(tiny::room(), 8, 8, samples, true);
  const SurfaceSample one = s.cloud.samples[100];
  for (SurfaceSample& sample : s.cloud.samples) sample = one;
  rebuild(s);
  return sane_rows(s);
}

// Half of them face one way, half the other.
Figures opposing_normals() {
  GatherSetup s(tiny::room(), 8, 8, samples, true);
  for (size_t j = 0; j < samples; ++j) {
    s.cloud.samples[j].position = s.cloud.samples[j / 2 * 2].position;
    const glm::vec3 n = s.cloud.samples[j / 2 * 2].geometric_normal;
    s.cloud.samples[j].geometric_normal = s.cloud.samples[j].shading_normal = j % 2 ? -n : n;
  }
  rebuild(s);
  return sane_rows(s);
}

Figures grid_in_one_plane() {
  GatherSetup s(tiny::room(), 8, 8, samples, true);
  for (size_t j = 0; j < samples; ++j) {
    s.cloud.samples[j].position = {static_cast<float>(j % 16) / 8.0f - 1.0f, -1.0f,
                                   static_cast<float>(j / 16) / 8.0f - 1.0f};
    s.cloud.samples[j].geometric_normal = s.cloud.samples[j].shading_normal = {0, 1, 0};
  }
  rebuild(s);
  return sane_rows(s);
}

// Floor, ceiling, and between them a sliver a million times longer than wide, on which some samples are put:
// by its area it would get none.
Figures slivers() {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  tiny::add_quad(scene, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
  const uint32_t a = tiny::add_vertex(scene, {-1, 0.5f, 0}, {0, -1, 0});
  tiny::add_vertex(scene, {1, 0.5f, 0}, {0, -1, 0});
  tiny::add_vertex(scene, {1, 0.5f, 2e-6f}, {0, -1, 0});
  tiny::add_triangle(scene, a, a + 1, a + 2);
  scene.camera.eye = {0.1f, 0.4f, 1.5f}, scene.camera.target = {0, 0.2f, 0};
  finish_scene(scene);
  GatherSetup s(std::move(scene), 8, 8, samples, true);
  for (size_t j = 0; j < 16; ++j) {
    s.cloud.samples[j].position = {static_cast<float>(j) / 8.0f - 0.95f, 0.5f, 1e-9f};
    s.cloud.samples[j].geometric_normal = s.cloud.samples[j].shading_normal = {0, -1, 0};
  }
  rebuild(s);
  return sane_rows(s);
}

}  // namespace

Cases precompute_cases() {
  return {{"gather samples at view samples", "r = 0 gives 0/0 unless facing and sign are tested first.",
           samples_coincide_with_the_view},
          {"all gather samples coincide", "All split keys are equal, clusters have no size.",
           all_samples_coincide},
          {"clusters of opposing normals", "A mean normal of zero has no direction.", opposing_normals},
          {"gather samples on a grid in one plane", "Split keys tie by the dozen.", grid_in_one_plane},
          {"slivers, fewer triangles than samples",
           "Areas that round to zero; samples that share a triangle.", slivers}};
}

}  // namespace relight::direct_to_indirect
