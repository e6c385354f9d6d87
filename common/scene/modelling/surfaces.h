// Curved parts: surfaces of revolution, parametric patches, tubes along curves, arcades, relief panels.
#pragma once

#include <functional>
#include <vector>

#include "common/scene/modelling/mesh_builder.h"

namespace relight::modelling {

// (radius, height) points from bottom to top with the outside on the right-hand side; a profile that starts
// and ends at radius 0 makes a closed solid.
using Profile = std::vector<glm::dvec2>;

// Radius factor at angle a and profile height y, for fluted shafts; 1 = round.
using Fluting = std::function<double(double angle, double height)>;

// Turns the profile about the frame's y axis with `sides` sides. Corners of the profile sharper than
// `crease_degrees` stay sharp.
void lathe(MeshBuilder& mesh, const Frame& frame, const Profile& profile, int sides,
           double crease_degrees = 40.0);
// The same with a radius factor, for a profile of radii > 0: normals from neighbouring points of the grid, no
// creases, flat caps at both ends.
void fluted_lathe(MeshBuilder& mesh, const Frame& frame, const Profile& profile, int sides,
                  const Fluting& fluting);

void sphere(MeshBuilder& mesh, const Frame& frame, double radius, int sides, int rows);

// Surface (s, t) in [0,1]^2 -> position, nu x nv cells; its outside is where d/ds x d/dt points. uv = (s, t).
void patch(MeshBuilder& mesh, int nu, int nv, const std::function<glm::dvec3(double s, double t)>& surface);

// Closed tube of `sides` sides around the polyline, radius from `radius` to `end_radius`, ends capped.
void tube(MeshBuilder& mesh, const std::vector<glm::dvec3>& curve, double radius, double end_radius,
          int sides);

// Wall along the frame's x axis from -length/2 to length/2, thickness along z, from y = spring to y = top,
// with `bays` round arches of radius `radius` cut out from below, and `end` of plain wall at both ends.
// Closed.
struct Arcade {
  double length, thickness, spring, top, radius;
  int bays, segments;
  double end = 0.0;
};
void arcade(MeshBuilder& mesh, const Frame& frame, const Arcade& shape);

// Panel in the frame's xy plane, [0, width] x [0, height], raised along +z by height(s, t) >= 0 above z =
// depth and closed at z = 0. The relief must be 0 on the rim.
void relief_panel(MeshBuilder& mesh, const Frame& frame, const glm::dvec3& size, int nu, int nv,
                  const std::function<double(double s, double t)>& relief);

// Thin two-sided leaf from `base` along `along` (its length), width `width`, bent downwards by `bend` of its
// length.
void leaf(MeshBuilder& mesh, const glm::dvec3& base, const glm::dvec3& along, double width, double bend,
          int cuts);

}  // namespace relight::modelling
