// The materials and directions that all BRDF tests go through.
#pragma once

#include <string>
#include <vector>

#include "common/brdf/brdf_lobes.h"
#include "tests/brdf/sphere_charts.h"

namespace relight::test {

struct BrdfCase {
  std::string name;
  shader::BrdfParams brdf;
};

// A glossy part beside Lambert; `tangent` in radians as in BrdfShape.
shader::BrdfParams with_part(const glm::vec3& diffuse, const GlossyPart& part, float tangent = 0.0f);

// Every model from its widest to its narrowest lobe (exponents 0 to 1e5, alpha 1 to 1e-3), isotropic and not,
// with and without a diffuse part; diffuse + glossy is at most 1, and exactly 1 in some.
std::vector<BrdfCase> brdf_cases();

// Unit direction of cosine `z` to +z.
glm::vec3 direction(double z, double azimuth);

// Towards the eye: along the normal exactly, oblique, and grazing to 1e-3.
std::vector<glm::vec3> eye_directions();

// Charts that resolve the density of directions sampled for wo. The surface's normal is +z.
SphereCharts charts(const shader::BrdfParams& brdf, const glm::vec3& wo);

}  // namespace relight::test
