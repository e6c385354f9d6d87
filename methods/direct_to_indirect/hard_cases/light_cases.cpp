// Lights at which a relight could divide by zero, lose its cone or find nothing to light.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "common/hard_cases/image_difference.h"
#include "common/hard_cases/tiny_scenes.h"
#include "methods/direct_to_indirect/hard_cases/bench.h"
#include "methods/direct_to_indirect/hard_cases/hard_cases.h"

namespace relight::direct_to_indirect {

namespace {

using namespace hard;

Figure lit(const Image& image) {
  return at_least("light of the picture", norm(image), 1e-9, "else the light reaches nothing");
}

Figures black_light() {
  MethodBench bench = transfer_bench(tiny::room());
  const Relit relit =
      bench.relight({{"device", "cpu"}}, tiny::lighting({tiny::omni({0.3f, 0.6f, 0.4f}, glm::vec3(0.0f))}));
  const auto& counters = bench.relight_log.counters();
  const auto count = [&](const char* name) {
    return counters.count(name) ? static_cast<double>(counters.at(name)) : 0.0;
  };
  return {at_most("light of the picture", norm(relit.total), 0.0, "black is exactly black"),
          at_most("lights shaded", count("lights_shaded"), 0.0, "a black light costs nothing"),
          at_most("shadow rays", count("shadow_rays"), 0.0, "a black light costs nothing")};
}

// The block of the room is closed: a light inside reaches nothing that the camera sees.
Figures light_inside_a_solid() {
  MethodBench bench = transfer_bench(tiny::room());
  RelitByBoth relit = relit_by_both(bench, tiny::omni({-0.3f, -0.5f, -0.3f}));
  relit.figures.push_back(at_most("direct light of the picture", norm(relit.cpu.direct), 0.0,
                                  "rays that start on the right side of a surface meet the block"));
  return relit.figures;
}

// Exactly at a sample of the view, and 1e-5 above one.
Figures light_at_a_sample() {
  MethodBench bench = transfer_bench(tiny::room(2.0f, glm::vec3(0.0f), true));
  const SurfaceSample& s = bench.buffer.direct[41 * 80 + 33];
  Figures figures = relit_by_both(bench, tiny::omni(s.position)).figures;
  const RelitByBoth above = relit_by_both(bench, tiny::omni(s.position + 1e-5f * s.geometric_normal));
  add_worst(figures, above.figures);
  figures.push_back(lit(above.cpu.direct));
  return figures;
}

// How far pixels lie outside of what their four sub-samples' shares of the omni's light allow, over the
// omni's.
double outside_of_shares(const MethodBench& bench, const Light& wide, const Image& by_spot,
                         const Image& by_omni, double& partly) {
  double worst = 0.0;
  for (size_t i = 0; i < by_spot.pixels.size(); ++i) {
    float least = 1.0f, largest = 0.0f;
    for (size_t s = 0; s < 4; ++s) {
      const SurfaceSample& sample = bench.buffer.direct[(2 * (i / 40) + s / 2) * 80 + 2 * (i % 40) + s % 2];
      const glm::vec3 d = glm::normalize(sample.position - wide.position);
      const float share = sample.valid ? shader::light_intensity(wide.params(), d).x : 0.0f;
      least = std::min(least, share), largest = std::max(largest, share);
    }
    const float full = by_omni.pixels[i].x, spot = by_spot.pixels[i].x;
    if (!(full > 0.0f)) continue;
    const double out = static_cast<double>(std::max(least * full - spot, spot - largest * full) / full);
    if (!(out <= worst)) worst = out;
    partly += least > 0.05f && largest < 0.95f;
  }
  return worst;
}

// Full opening 0.1 degrees (cosines of inner and outer cone differ by a few roundings) and 179 degrees.
Figures narrow_and_wide_cones() {
  MethodBench bench = transfer_bench(tiny::room());
  const glm::vec3 position(0.5f, 0.9f, 0.2f);
  const SurfaceSample& target = bench.buffer.direct[47 * 80 + 40];
  const RelitByBoth thin =
      relit_by_both(bench, tiny::spot(position, target.position - position, 0.02f, 0.05f, glm::vec3(100.0f)));
  Figures figures = thin.figures;
  figures.push_back(lit(thin.cpu.direct));
  const Light wide = tiny::spot(position, {0, -1, 0}, 60.0f, 89.5f);
  const RelitByBoth by_spot = relit_by_both(bench, wide),
                    by_omni = relit_by_both(bench, tiny::omni(position));
  add_worst(figures, by_spot.figures);
  add_worst(figures, by_omni.figures);
  double partly = 0.0;
  figures.push_back(at_most("179 degrees: light beyond the shares of a pixel's sub-samples",
                            outside_of_shares(bench, wide, by_spot.cpu.direct, by_omni.cpu.direct, partly),
                            1e-5, "every pixel has between the least and the largest of the four; rounding"));
  figures.push_back(
      at_least("pixels in the cone's penumbra", partly, 21.0, "else the cone's edge is not seen"));
  return figures;
}

// The reflected direct light of a Lambert view under one omni in double precision, shadows by single rays:
// |direct - that| / |that|.
double difference_from_double(const MethodBench& bench, const Light& light, const Image& direct) {
  double norm2 = 0.0, wrong2 = 0.0;
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
    wrong2 += glm::dot(d, d), norm2 += glm::dot(0.25 * sum, 0.25 * sum);
  }
  return std::sqrt(wrong2 / norm2);
}

// 1 / r^2 spans eight orders of magnitude in one picture, and the light's own shadow rays graze the wall.
Figures light_near_a_wall() {
  MethodBench bench = transfer_bench(tiny::room());
  const float height = 1e-4f * bench.scene.bounds.diagonal();
  Figures figures;
  for (const glm::vec3& position :
       {glm::vec3(0.4f, -1.0f + height, 0.3f), glm::vec3(0.4f, 0.2f, -1.0f + height),
        glm::vec3(-1.0f + height, -1.0f + height, -1.0f + height)}) {
    const Light light = tiny::omni(position, glm::vec3(0.01f));
    const RelitByBoth relit = relit_by_both(bench, light);
    add_worst(figures, relit.figures);
    add_worst(figures, at_most("direct light, from its definition in double",
                               difference_from_double(bench, light, relit.cpu.direct), 3.4e-4,
                               "height over distance is exact to 2^-24 x coordinate / height"));
  }
  return figures;
}

}  // namespace

Cases light_cases() {
  return {{"a black light", "Work and rounding for a light that gives nothing.", black_light},
          {"a light inside a solid", "Shadow rays that start on the wrong side of a surface.",
           light_inside_a_solid},
          {"a light at a view sample", "r = 0 gives 0/0, r near 0 overflows.", light_at_a_sample},
          {"spot cones of 0.1 and 179 degrees", "A cone's cosine is rounded to 1, or taken for exact.",
           narrow_and_wide_cones},
          {"a light 1e-4 diagonals from a wall", "The cosine cancels digits, shadow rays graze the wall.",
           light_near_a_wall}};
}

}  // namespace relight::direct_to_indirect
