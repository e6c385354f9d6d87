// Light exchanged by two rectangles, one parallel and one perpendicular to the other, against their analytic
// form factors. The first rectangle shines, or is lit by a far lamp and reflects; the second receives.
// (analytic_test.cpp has two plates with a near point light, against quadrature.)
#include <cmath>

#include "tests/support/form_factors.h"
#include "tests/support/radiance_meter.h"
#include "tests/support/tiny_scenes.h"

namespace relight::check {
namespace {

constexpr double receiver_albedo = 0.8, source_albedo = 0.6, shine = 3.0;

// The receiver is the unit square at y = 0, seen from above.
const Rectangle receiver{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
const Rectangle parallel{{0.2, 0.7, -0.1}, {1.1, 0, 0}, {0, 0, 0.9}};
const Rectangle perpendicular{{0, 0, 0}, {0, 0.8, 0}, {0, 0, 1}};  // shares an edge with the receiver

void add(Scene& scene, const Rectangle& r, uint32_t material) {
  tiny::add_quad(scene, glm::vec3(r.corner), glm::vec3(r.a), glm::vec3(r.b), material);
}

Scene two_rectangles(const Rectangle& source, double emission) {
  Scene scene = tiny::empty_scene(glm::vec3(static_cast<float>(receiver_albedo)));
  Material material;
  material.diffuse = glm::vec3(static_cast<float>(source_albedo));
  material.emission = glm::vec3(static_cast<float>(emission));
  add(scene, receiver, 0);
  add(scene, source, tiny::add_material(scene, material));
  finish_scene(scene);
  return scene;
}

// A picture that is exactly the receiver: a plane square to the view is seen without distortion, so the mean
// over the pixels is the mean over the area, by a midpoint rule of 2 `side` points a side.
View whole_receiver(int side) {
  const float height = 0.4f;
  return {{{0.5f, height, 0.5f}, {0.5f, 0, 0.5f}, {0, 0, -1}, glm::degrees(2.0f * std::atan(0.5f / height))},
          side,
          side};
}

// What that midpoint rule makes of the form factor, whose analytic mean is known.
double midpoint_error(const Rectangle& source, int side) {
  double mean = 0.0;
  const int n = 2 * side;
  for (int i = 0; i < n * n; ++i)
    mean += form_factor(receiver.at((i % n + 0.5) / n, (i / n + 0.5) / n), {0, 1, 0}, source) / (n * n);
  return std::abs(mean - form_factor(receiver, source));
}

// Mean over the receiver and at single points. Red if: a cosine, 1/pi or an albedo is lost, the picture is
// sampled unevenly, or light passes where there is no surface. Tried: BRDF sampling without the cosine,
// throughput x 1.02, emission counted at the wrong bounce, next-event estimation without its cosine.
void expect_form_factor(const Rectangle& source, const RadianceMeter& meter, const Light& light,
                        double source_radiance, double source_error, const Effort& effort) {
  const double scale = receiver_albedo * source_radiance;
  const int side = 24;
  const double factor = form_factor(receiver, source);
  const Reading mean = meter.read(whole_receiver(side), light, {effort.samples / 4, effort.seeds});
  expect_reads(mean, glm::dvec3(scale * factor),
               scale * (midpoint_error(source, side) + source_error * factor), 0.01);
  for (const glm::dvec3& p : {glm::dvec3(0.5, 0, 0.5), glm::dvec3(0.15, 0, 0.8), glm::dvec3(0.9, 0, 0.3)}) {
    SCOPED_TRACE(testing::Message() << "at " << p.x << " " << p.z);
    const double at_point = form_factor(p, {0, 1, 0}, source);
    const Reading reading = meter.read(glm::vec3(p + glm::dvec3(0.0, 0.1, 0.0)), glm::vec3(p), light, effort);
    expect_reads(reading, glm::dvec3(scale * at_point), scale * source_error * at_point, 0.02);
  }
}

TEST(FormFactorIrradiance, OfAShiningRectangle) {
  for (const Rectangle& source : {parallel, perpendicular}) {
    const RadianceMeter meter(two_rectangles(source, shine), {});
    expect_form_factor(source, meter, {0, 0, true}, shine, 0.0, {512, 24});
  }
}

// So far away that the irradiance E of the source varies by less than `uneven` of its value; so slanting that
// the rectangles don't shadow each other. The receiver's own direct light is not read.
TEST(FormFactorIrradiance, OfALitRectangle) {
  const double far = 1e4, uneven = 3.0 * 0.8 / far, irradiance = 2.0;
  for (const Rectangle& source : {parallel, perpendicular}) {
    const glm::dvec3 along = glm::normalize(source.normal() + glm::dvec3(0.0, 0.0, -1.9));
    const glm::dvec3 position = source.at(0.5, 0.5) + far * along;
    const double intensity = irradiance * far * far / glm::dot(along, source.normal());
    const RadianceMeter meter(
        two_rectangles(source, 0.0),
        tiny::lighting({tiny::omni(glm::vec3(position), glm::vec3(static_cast<float>(intensity)))}));
    expect_form_factor(source, meter, {1, 1}, source_albedo / M_PI * irradiance, uneven, {512, 24});
  }
}

}  // namespace
}  // namespace relight::check
