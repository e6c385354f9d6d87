// Integrals over the sphere of functions with known, possibly very narrow, peaks: midpoint rule in
// coordinates that spread the peaks out.
#pragma once

#include <functional>
#include <vector>

#include <glm/glm.hpp>

namespace relight::test {

struct ChartPoint {
  glm::dvec3 direction;
  double jacobian;  // solid angle for the whole unit square of (t, azimuth / 2 pi)
};

class SphereCharts {
 public:
  // Polar coordinates about each axis (any length), rings growing geometrically from 1e-5 rad; every
  // direction belongs to its nearest axis.
  static SphereCharts around(const std::vector<glm::vec3>& axes);
  // Directions as mirror images of wo in half vectors (columns of frame: u, v, n); the half vector has the
  // slopes widths.x r cos(azimuth) and widths.y r sin(azimuth), r geometric from 1e-3 to 1e6.
  static SphereCharts of_half_vectors(const glm::mat3& frame, const glm::vec3& wo, const glm::vec2& widths);

  double integrate(const std::function<double(const glm::vec3&)>& f, int rings = 800,
                   int sectors = 128) const;

  // Point of chart `chart` for t in (0,1), azimuth in [0, 2 pi).
  ChartPoint at(size_t chart, double t, double azimuth) const;
  // Inverse for the first chart: (t, azimuth).
  glm::dvec2 coordinates(const glm::dvec3& direction) const;

 private:
  bool half_vectors_ = false;
  std::vector<glm::dmat3> frames_;  // one a chart; third column: its axis or n
  glm::dvec3 wo_{0.0};
  glm::dvec2 widths_{1.0};
};

}  // namespace relight::test
