// One light of every type in a room of 4 x 3 x 4 (tests/shading/shading_fixture.h): the tests that each type
// must pass run over this list.
#pragma once

#include <string>
#include <vector>

#include "common/lights/emitter.h"
#include "common/sampling/surface_sample.h"

namespace relight::test {

Light directional_light(const glm::vec3& direction, const glm::vec3& irradiance = glm::vec3(3, 2, 1));
// Half edges u and v, shining along cross(u, v).
Light rectangle_light(const glm::vec3& centre, const glm::vec3& u, const glm::vec3& v,
                      const glm::vec3& radiance = glm::vec3(5, 4, 3));
Light disc_light(const glm::vec3& centre, const glm::vec3& direction, float radius,
                 const glm::vec3& radiance = glm::vec3(5, 4, 3));

// A projector with a slide of 4 x 3 random texels.
Light projector_light(const glm::vec3& position, const glm::vec3& direction);
// An uber-light that uses every control, with the same slide.
Light uber_light(const glm::vec3& position, const glm::vec3& direction);

// All types that the CPU shades, by the light's name.
std::vector<Light> light_cases();

// For each sample a bound on what rounding of its radiance can refer to: 1/pi x the largest unshadowed
// irradiance that any normal there would get, times how much the model magnifies the rounding of a direction.
std::vector<float> rounding_scale_of(const std::vector<SurfaceSample>& samples,
                                     const std::vector<Emitter>& lights);

}  // namespace relight::test
