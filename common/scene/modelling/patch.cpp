#include <cmath>
#include <numbers>

#include "common/scene/modelling/surfaces.h"

namespace relight::modelling {

void patch(MeshBuilder& mesh, int nu, int nv, const std::function<glm::dvec3(double s, double t)>& surface) {
  std::vector<glm::dvec3> points;
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) points.push_back(surface(double(i) / nu, double(j) / nv));
  const auto at = [&](int i, int j) {
    return static_cast<size_t>(glm::clamp(j, 0, nv) * (nu + 1) + glm::clamp(i, 0, nu));
  };
  const auto first = static_cast<uint32_t>(mesh.scene().positions.size());
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) {
      const glm::dvec3 ds = points[at(i + 1, j)] - points[at(i - 1, j)];
      const glm::dvec3 dt = points[at(i, j + 1)] - points[at(i, j - 1)];
      mesh.vertex(points[at(i, j)], glm::cross(ds, dt), {double(i) / nu, double(j) / nv});
    }
  const auto index = [&](int i, int j) { return first + static_cast<uint32_t>(at(i, j)); };
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      mesh.quad(index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
}

void leaf(MeshBuilder& mesh, const glm::dvec3& base, const glm::dvec3& along, double width, double bend,
          int cuts) {
  const double length = glm::length(along);
  const Frame frame = standing_along(base, along);
  // The side direction is level, so that the leaf hangs symmetrically.
  glm::dvec3 side = glm::cross(glm::dvec3(0, 1, 0), along);
  side = glm::length(side) > 0.01 * length ? glm::normalize(side) : frame.axes[0];
  patch(mesh, cuts, 2 * cuts, [&](double s, double t) {
    // The tips have 2 % of the width, so that no cell is degenerate.
    const double half = 0.5 * width * (0.02 + 0.98 * std::sin(std::numbers::pi * std::pow(t, 0.8)));
    const double across = 2.0 * s - 1.0;
    const double fold = 0.25 * half * std::abs(across);
    return base + along * t + side * (across * half) + glm::dvec3(0, fold - bend * length * t * t, 0);
  });
}

void relief_panel(MeshBuilder& mesh, const Frame& frame, const glm::dvec3& size, int nu, int nv,
                  const std::function<double(double s, double t)>& relief) {
  const auto front = [&](double s, double t) {
    const bool rim = s == 0.0 || s == 1.0 || t == 0.0 || t == 1.0;
    return frame.point({s * size.x, t * size.y, size.z + (rim ? 0.0 : relief(s, t))});
  };
  patch(mesh, nu, nv, front);
  const auto back = [&](double s, double t) { return frame.point({s * size.x, t * size.y, 0.0}); };
  // Rims and back are cut like the front, or the solid would not be closed where they meet.
  patch(mesh, nu, 1, [&](double s, double t) { return t == 0.0 ? back(s, 0.0) : front(s, 0.0); });
  patch(mesh, nu, 1, [&](double s, double t) { return t == 0.0 ? front(s, 1.0) : back(s, 1.0); });
  patch(mesh, 1, nv, [&](double s, double t) { return s == 0.0 ? back(0.0, t) : front(0.0, t); });
  patch(mesh, 1, nv, [&](double s, double t) { return s == 0.0 ? front(1.0, t) : back(1.0, t); });
  // The back is a fan from its middle: few triangles for a side that is rarely seen.
  const glm::dvec3 normal = -frame.axes[2];
  const uint32_t middle = mesh.vertex(back(0.5, 0.5), normal, {0.5, 0.5});
  const auto rim = [&](const glm::dvec3& p) { return mesh.vertex(p, normal); };
  for (int i = 0; i < nu; ++i) {
    const double s = double(i) / nu, e = double(i + 1) / nu;
    mesh.triangle(middle, rim(back(e, 0.0)), rim(back(s, 0.0)));
    mesh.triangle(middle, rim(back(s, 1.0)), rim(back(e, 1.0)));
  }
  for (int j = 0; j < nv; ++j) {
    const double s = double(j) / nv, e = double(j + 1) / nv;
    mesh.triangle(middle, rim(back(0.0, s)), rim(back(0.0, e)));
    mesh.triangle(middle, rim(back(1.0, e)), rim(back(1.0, s)));
  }
}

}  // namespace relight::modelling
