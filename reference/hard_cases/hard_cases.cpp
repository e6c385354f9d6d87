#include "reference/hard_cases/hard_cases.h"

#include <cmath>

#include <glm/gtc/constants.hpp>

#include "common/brdf/brdf_lobes.h"
#include "common/hard_cases/image_difference.h"
#include "common/hard_cases/tiny_scenes.h"
#include "reference/hard_cases/radiance_meter.h"

namespace relight {

namespace {

using namespace hard;
using check::RadianceMeter;
using check::Reading;

// `bias`: relative error of the expected value itself. A reading that is noisier than `resolution` proves
// nothing.
Figures reads(const Reading& reading, double expected, double bias, double resolution) {
  const double noise = 5.5 * reading.error.x + (bias + check::rounding) * expected;
  return {at_most("samples that are not finite", static_cast<double>(reading.non_finite), 0.0,
                  "they are replaced by zero, and the picture is too dark"),
          at_most("deviation over what noise and rounding allow", std::abs(reading.mean.x - expected) / noise,
                  1.0, "5.5 standard errors over 24 seeds: a false alarm in 70,000"),
          at_most("what noise and rounding allow, relative", noise / expected, resolution,
                  "a noisier reading would prove nothing")};
}

// All of one irradiated spot: an omni light h over a floor puts the fraction 1 - h / sqrt(h^2 + rho^2) of
// what goes down within the distance rho. The irradiance of a point of the wall x = 1 from the floor, by
// midpoints of equal light.
double irradiance_from_the_floor(const glm::dvec3& p, const glm::dvec3& light, double h, double albedo) {
  constexpr int rings = 4000, spokes = 64;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double u = 1.0 - (i + 0.5) / rings, rho = h * std::sqrt(1.0 / (u * u) - 1.0);
    for (int j = 0; j < spokes; ++j) {
      const double phi = 2.0 * glm::pi<double>() * (j + 0.5) / spokes;
      const glm::dvec3 q(light.x + rho * std::cos(phi), -1.0, light.z + rho * std::sin(phi));
      if (std::abs(q.x) > 1.0 || std::abs(q.z) > 1.0) continue;
      const glm::dvec3 w = q - p;
      const double r2 = glm::dot(w, w);
      sum += (p.x - q.x) * (p.y - q.y) / (r2 * r2);
    }
  }
  return sum * 2.0 * glm::pi<double>() / (rings * spokes) * albedo / glm::pi<double>();
}

Figures light_near_a_wall() {
  Scene scene = tiny::empty_scene(glm::vec3(0.7f));
  tiny::add_quad(scene, {-1, -1, -1}, {0, 0, 2}, {2, 0, 0});
  tiny::add_quad(scene, {1, -1, -1}, {0, 0, 2}, {0, 2, 0});
  finish_scene(scene);
  const double h = 1e-4 * static_cast<double>(scene.bounds.diagonal());
  const glm::vec3 light(0.1f, -1.0f + static_cast<float>(h), -0.2f), target(1.0f, 0.2f, 0.1f);
  const RadianceMeter meter(std::move(scene), tiny::lighting({tiny::omni(light)}));
  const Reading reading = meter.read({0.2f, 0.1f, 0.1f}, target, {}, {64, 24, Estimator::light_vertex});
  const double height = static_cast<double>(light.y) + 1.0;  // as float has it
  const double albedo = 0.7f;
  const double expected =
      albedo / glm::pi<double>() * irradiance_from_the_floor(target, light, height, albedo);
  // Rays start an offset above the floor: a share offset / h of the way to the light.
  return reads(reading, expected, 2.0 * meter.ray_offset() / h + 1e-3, 0.1);
}

Scene furnace_scene(double albedo) {
  Scene scene = tiny::empty_scene(glm::vec3(static_cast<float>(albedo)));
  scene.materials[0].emission = glm::vec3(1.0f);
  tiny::add_box(scene, {-1, -1, -1}, {1, 2, 1.5f});
  return scene;
}

check::Effort quiet_effort(int samples) {
  check::Effort effort{samples, 24};
  effort.sample_extended_lights = false;  // emitters found by BRDF rays alone: without noise in a furnace
  return effort;
}

// A closed box that shines with radiance 1: k bounces bring albedo^(k+1).
Figures closed_box() {
  Scene scene = furnace_scene(0.95);
  finish_scene(scene);
  const RadianceMeter meter(std::move(scene), {});
  const glm::vec3 eye(0.3f, 0.2f, 0.4f), wall(-1.0f, 0.1f, -0.8f);
  const double rho = 0.95f;
  const auto series = [&](int last) { return rho * (1.0 - std::pow(rho, last + 1)) / (1.0 - rho); };
  const Reading all = meter.read(eye, wall, {0, 200, true}, quiet_effort(128));
  const Reading four = meter.read(eye, wall, {0, 4, true}, quiet_effort(64));
  Figures figures = reads(all, series(200), 1e-5, 0.02);
  add_worst(figures, reads(four, series(4), 1e-5, 0.02));
  figures.push_back(at_most("share that four bounces leave out, off its exact value",
                            std::abs((1.0 - four.mean.x / all.mean.x) - (1.0 - series(4) / series(200))),
                            0.01, "77 % of the light is beyond them: a method of few bounces must say so"));
  return figures;
}

std::vector<GlossyPart> sharp_and_wide_lobes() {
  const glm::vec3 f(0.9f);
  return {phong_part(f, largest_exponent), phong_part(f, 0.0f),
          ashikhmin_shirley_part(f, 10.0f, largest_exponent), ggx_part(f, smallest_alpha, smallest_alpha),
          ggx_part(f, 1.0f, 1.0f)};
}

// Eyes at a ten-thousandth of the room over the wall that they look at.
Figures grazing_angles() {
  const glm::vec3 eye(-1.0f + 1e-4f, 0.1f, 0.4f), wall(-1.0f, 0.1f, -0.8f);
  Scene matt = furnace_scene(0.5);
  finish_scene(matt);
  Figures figures = reads(RadianceMeter(std::move(matt), {}).read(eye, wall, {1, 1, true}, quiet_effort(16)),
                          0.25, 0.0, 0.05);
  for (const GlossyPart& part : sharp_and_wide_lobes()) {
    Scene scene = furnace_scene(0.0);
    scene.materials[0].set_glossy_part(part);
    finish_scene(scene);
    check::Light light{0, 0, true};
    light.glossy = true;
    const Reading r = RadianceMeter(std::move(scene), {}).read(eye, wall, light, quiet_effort(64));
    add_worst(figures, at_most("samples that are not finite", static_cast<double>(r.non_finite), 0.0,
                               "they are replaced by zero, and the picture is too dark"));
    add_worst(figures, at_most("share of even light that a lobe reflects, less its noise",
                               r.mean.x - 5.5 * r.error.x, 1.0 + check::rounding, "no more than arrives"));
  }
  return figures;
}

// The room with its lights; intensities scale with area so that radiance stays.
PathTracerResult render_at(float scale) {
  const Scene scene = tiny::room(2.0f * scale, glm::vec3(0.0f), true);
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 24, 18});
  const glm::vec3 power(scale * scale);
  PathTracerSettings settings;
  settings.paths.max_bounces = 2;
  settings.paths.glossy_at_eye = settings.paths.glossy_interior = true;
  settings.samples_per_pixel = 64, settings.batches = 2;
  Progress quiet(true);
  StageLog log;
  return path_trace(
      tracer, buffer,
      tiny::lighting({tiny::omni(scale * glm::vec3(0.3f, 0.6f, 0.4f), power),
                      tiny::spot(scale * glm::vec3(-0.4f, 0.9f, 0.3f), {0.3f, -1.0f, 0.1f}, 15, 25, power)}),
      settings, quiet, log);
}

// The random numbers are the same, so only rounding differs.
Figures tiny_and_huge_scenes() {
  const PathTracerResult original = render_at(1.0f);
  Figures figures;
  for (const float scale : {1e-3f, 1e-1f, 1e3f}) {
    const PathTracerResult scaled = render_at(scale);
    add_worst(figures, at_most("samples that are not finite", static_cast<double>(scaled.non_finite), 0.0,
                               "1/r^2 stays within the range of float"));
    add_worst(figures, at_most("relative difference of direct light",
                               relative_difference(scaled.direct, original.direct), 1e-3,
                               "single shadow rays may change sides at an edge; most don't"));
    add_worst(figures, at_most("relative difference of indirect light",
                               relative_difference(scaled.indirect, original.indirect), 5e-3,
                               "single paths may change sides at an edge; most don't"));
  }
  return figures;
}

}  // namespace

Cases reference_hard_cases() {
  return {{"a light 1e-4 diagonals from a wall",
           "All light on a spot that few paths find; grazing shadow rays.", light_near_a_wall},
          {"a closed box of albedo 0.95", "Long paths hold most of the light: ended early, it is lost.",
           closed_box},
          {"eyes that graze the surface", "Densities of 0 and infinity; self-shadowing.", grazing_angles},
          {"scenes of a thousandth and a thousand times the size",
           "An absolute epsilon shows at another unit of length.", tiny_and_huge_scenes}};
}

}  // namespace relight
