// One bounce off an infinite diffuse plane lit by a point light, against an integral in double precision and,
// where there is one, its closed form.
#include <cmath>

#include "tests/support/radiance_meter.h"
#include "tests/support/tiny_scenes.h"

namespace relight::check {
namespace {

constexpr double plane_albedo = 0.7, receiver_albedo = 0.6, intensity = 5.0, light_height = 0.5;
constexpr double half_side = 10.0;  // of the quad that stands for the plane

// Irradiance of a point at height z that faces down, d aside from the light. The cosine-weighted mean of the
// plane's radiance albedo/pi I h / r^3, times pi: midpoints over u = sin^2 (radius z sqrt(u / (1 - u))) and
// azimuth; both integrands are smooth and the azimuth's is periodic.
double irradiance(double z, double d, int n) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 64; ++j) {
      const double u = (i + 0.5) / n, s = z * std::sqrt(u / (1.0 - u)), phi = 2.0 * M_PI * (j + 0.5) / 64;
      const double r2 = s * s + d * d - 2.0 * s * d * std::cos(phi) + light_height * light_height;
      sum += plane_albedo / M_PI * intensity * light_height / (r2 * std::sqrt(r2));
    }
  return M_PI * sum / (64.0 * n);
}

// The largest part of it that comes from beyond the quad: there r >= R - d and the kernel is below z^2 / s^4.
double beyond(double z, double d) {
  const double near = half_side - d;
  return 0.4 * plane_albedo * intensity * light_height * z * z / std::pow(near, 5);
}

// At z = h above the light's foot the integral is 2/5 albedo I / h^2.
TEST(InfinitePlane, TheQuadratureEqualsTheClosedForm) {
  EXPECT_NEAR(irradiance(light_height, 0.0, 4000),
              0.4 * plane_albedo * intensity / (light_height * light_height), 1e-6);
  EXPECT_NEAR(irradiance(0.8, 0.6, 1000), irradiance(0.8, 0.6, 4000), 1e-6);
}

// A small plate above the light, seen from below. It is never between the light and the plane.
RadianceMeter plate_above_plane(double z, double d) {
  Scene scene = tiny::empty_scene(glm::vec3(static_cast<float>(plane_albedo)));
  Material plate;
  plate.diffuse = glm::vec3(static_cast<float>(receiver_albedo));
  const float side = static_cast<float>(2.0 * half_side), half = 0.5f * side;
  tiny::add_quad(scene, {-half, 0, -half}, {0, 0, side}, {side, 0, 0});
  tiny::add_quad(scene, {static_cast<float>(d) - 0.05f, static_cast<float>(z), -0.05f}, {0.1f, 0, 0},
                 {0, 0, 0.1f}, tiny::add_material(scene, plate));
  finish_scene(scene);
  return RadianceMeter(std::move(scene),
                       tiny::lighting({tiny::omni({0, static_cast<float>(light_height), 0},
                                                  glm::vec3(static_cast<float>(intensity)))}));
}

// Red if: 1/r^2, a cosine at either end, 1/pi or an albedo is lost in either estimator; its light reaches far
// along the plane, at grazing angles. Tried: next-event estimation without its cosine, area_pdf without cos,
// connection without 1/d^2, throughput x 1.02.
void expect_plane(const Effort& effort) {
  for (const glm::dvec2& place : {glm::dvec2(0.6, 0.0), glm::dvec2(1.0, 0.8), glm::dvec2(3.0, 2.0)}) {
    const double z = place.x, d = place.y;
    SCOPED_TRACE(testing::Message() << "height " << z << ", aside " << d);
    const glm::vec3 target(static_cast<float>(d), static_cast<float>(z), 0.0f);
    const RadianceMeter meter = plate_above_plane(z, d);
    const Reading reading = meter.read(target - glm::vec3(0, 0.05f, 0), target, {1, 1}, effort);
    const double expected = irradiance(z, d, 2000);
    const double moved = std::abs(irradiance(z - meter.ray_offset(), d, 2000) - expected);
    const double scale = receiver_albedo / M_PI;
    expect_reads(reading, glm::dvec3(scale * expected), scale * (beyond(z, d) + moved + 2e-6), 0.02);
  }
}

TEST(InfinitePlane, OneBounceByNextEvent) { expect_plane({1024, 24}); }
TEST(InfinitePlane, OneBounceByLightVertices) { expect_plane({128, 24, Estimator::light_vertex}); }

}  // namespace
}  // namespace relight::check
