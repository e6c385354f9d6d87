#include <cmath>
#include <numbers>

#include "common/scene/modelling/surfaces.h"

namespace relight::modelling {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// Outward normal (radial, axial) of the profile's segment i.
glm::dvec2 segment_normal(const Profile& profile, size_t i) {
  const glm::dvec2 d = profile[i + 1] - profile[i];
  return glm::normalize(glm::dvec2(d.y, -d.x));
}

// Normal of segment i at its end point `point`: shared with the neighbouring segment unless the corner is
// sharp, and along the axis at a smooth pole.
glm::dvec2 corner_normal(const Profile& profile, size_t i, size_t point, double cos_crease) {
  const glm::dvec2 own = segment_normal(profile, i);
  const bool at_start = point == i;
  if (profile[point].x == 0.0) {
    const glm::dvec2 pole(0.0, at_start ? -1.0 : 1.0);
    return glm::dot(own, pole) > cos_crease ? pole : own;
  }
  if (at_start ? i == 0 : i + 2 == profile.size()) return own;
  const glm::dvec2 other = segment_normal(profile, at_start ? i - 1 : i + 1);
  return glm::dot(own, other) > cos_crease ? glm::normalize(own + other) : own;
}

}  // namespace

void lathe(MeshBuilder& mesh, const Frame& frame, const Profile& profile, int sides, double crease_degrees) {
  const double cos_crease = std::cos(glm::radians(crease_degrees));
  std::vector<glm::dvec2> circle;
  for (int i = 0; i <= sides; ++i) {
    const double a = two_pi * (i % sides) / sides;
    circle.emplace_back(std::cos(a), std::sin(a));
  }
  const auto ring = [&](size_t point, const glm::dvec2& normal) {
    const auto first = static_cast<uint32_t>(mesh.scene().positions.size());
    const glm::dvec2 p = profile[point];
    for (size_t i = 0; i < circle.size(); ++i) {
      const glm::dvec2 c = circle[i];
      mesh.vertex(frame.point({p.x * c.x, p.y, p.x * c.y}),
                  frame.vector({normal.x * c.x, normal.y, normal.x * c.y}), {double(i) / sides, p.y});
    }
    return first;
  };
  glm::dvec2 last_normal(0.0);
  uint32_t last_ring = 0;
  for (size_t i = 0; i + 1 < profile.size(); ++i) {
    const glm::dvec2 low_normal = corner_normal(profile, i, i, cos_crease);
    const uint32_t low = i > 0 && low_normal == last_normal ? last_ring : ring(i, low_normal);
    last_normal = corner_normal(profile, i, i + 1, cos_crease);
    const uint32_t high = last_ring = ring(i + 1, last_normal);
    for (uint32_t k = 0; k < static_cast<uint32_t>(sides); ++k)
      mesh.quad(low + k, high + k, high + k + 1, low + k + 1);
  }
}

void fluted_lathe(MeshBuilder& mesh, const Frame& frame, const Profile& profile, int sides,
                  const Fluting& fluting) {
  const int rows = static_cast<int>(profile.size());
  const auto grid = static_cast<size_t>(rows) * static_cast<size_t>(sides);
  std::vector<glm::dvec3> points(grid);
  std::vector<glm::dvec2> circle;
  for (int i = 0; i < sides; ++i)
    circle.emplace_back(std::cos(two_pi * i / sides), std::sin(two_pi * i / sides));
  const auto at = [&](int j, int i) {
    return static_cast<size_t>(j) * static_cast<size_t>(sides) + static_cast<size_t>((i + sides) % sides);
  };
  for (int j = 0; j < rows; ++j) {
    const glm::dvec2 p = profile[static_cast<size_t>(j)];
    for (int i = 0; i < sides; ++i) {
      const double r = p.x * fluting(two_pi * i / sides, p.y);
      const glm::dvec2 c = circle[static_cast<size_t>(i)];
      points[at(j, i)] = frame.point({r * c.x, p.y, r * c.y});
    }
  }
  const auto first = static_cast<uint32_t>(mesh.scene().positions.size());
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i <= sides; ++i) {
      const glm::dvec3 up = points[at(std::min(j + 1, rows - 1), i)] - points[at(std::max(j - 1, 0), i)];
      const glm::dvec3 around = points[at(j, i + 1)] - points[at(j, i - 1)];
      mesh.vertex(points[at(j, i)], glm::cross(up, around),
                  {double(i) / sides, profile[static_cast<size_t>(j)].y});
    }
  const auto index = [&](int j, int i) { return first + static_cast<uint32_t>(j * (sides + 1) + i); };
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i < sides; ++i)
      mesh.quad(index(j, i), index(j + 1, i), index(j + 1, i + 1), index(j, i + 1));
  const auto cap = [&](int j, double up) {
    const glm::dvec3 normal = up * frame.axes[1];
    const uint32_t middle = mesh.vertex(frame.point({0.0, profile[static_cast<size_t>(j)].y, 0.0}), normal);
    for (int i = 0; i < sides; ++i) {
      const uint32_t a = mesh.vertex(points[at(j, i)], normal), b = mesh.vertex(points[at(j, i + 1)], normal);
      up > 0.0 ? mesh.triangle(middle, b, a) : mesh.triangle(middle, a, b);
    }
  };
  cap(0, -1.0);
  cap(rows - 1, 1.0);
}

void sphere(MeshBuilder& mesh, const Frame& frame, double radius, int sides, int rows) {
  Profile profile;
  for (int j = 0; j <= rows; ++j) {
    const double a = std::numbers::pi * j / rows;
    profile.emplace_back(j == 0 || j == rows ? 0.0 : radius * std::sin(a), -radius * std::cos(a));
  }
  // Few rows make large turns; a sphere is smooth everywhere.
  lathe(mesh, frame, profile, sides, 179.0);
}

}  // namespace relight::modelling
