// A dense radiosity solver in double precision: the light of a diffuse room of axis-aligned rectangles with
// at most one block in it, computed without rays of the program, random numbers or float.
//
// Rectangles are cut into cells of constant radiosity (Goral et al., "Modeling the Interaction of Light
// Between Diffuse Surfaces", 1984). Form factors between cells are analytic, times the visible fraction by a
// weighted count over pairs of points where the block may stand between them. The error falls with the square
// of the cell size (tests/reference/radiosity_solver_test.cpp), so two solutions bound it.
#pragma once

#include <optional>
#include <vector>

#include "tests/support/form_factors.h"

namespace relight::check {

struct Surface {
  Rectangle shape;
  glm::dvec3 albedo, emission{0.0};  // emitted radiance, front side
};

// Axis-aligned, opaque. Its own faces are Surfaces too.
struct Block {
  glm::dvec3 lo, hi;
  // Does the open segment from p to q run through the inside?
  bool hides(const glm::dvec3& p, const glm::dvec3& q) const;
};

// Radiosities [W/m^2] of all cells: pi times radiance.
using Radiosities = std::vector<glm::dvec3>;

class RadiosityRoom {
 public:
  // Every rectangle is cut into cells with sides of `cell` (its sides must be multiples of it); the block's
  // planes must not cut a cell.
  RadiosityRoom(const std::vector<Surface>& surfaces, const std::optional<Block>& block, double cell);

  size_t cells() const { return cells_.size(); }
  double form_factor_sum(size_t i) const;  // of row i; 1 in a closed room
  bool hidden(size_t i) const;             // inside the block's footprint

  Radiosities emitted() const;
  // What the cells reflect of a point light's direct light.
  Radiosities lit_by(const glm::dvec3& position, const glm::dvec3& intensity) const;
  // One bounce: albedo times the light that arrives from `b`.
  Radiosities bounce(const Radiosities& b) const;
  // source + bounce(source) + bounce(bounce(source)) + ...: Gauss-Seidel until nothing changes by 1e-12.
  Radiosities solve(const Radiosities& source) const;
  // Irradiance of a surface point from cells of radiosities b.
  glm::dvec3 irradiance(const glm::dvec3& point, const glm::dvec3& normal, const Radiosities& b) const;

 private:
  struct Cell {
    Rectangle shape;
    glm::dvec3 normal, albedo, emission;
  };
  bool may_hide(const Rectangle& a, const Rectangle& b) const;
  double visible_fraction(const Cell& a, const Cell& b) const;
  double& factor(size_t i, size_t j) { return factors_[i * cells_.size() + j]; }
  const double& factor(size_t i, size_t j) const { return factors_[i * cells_.size() + j]; }

  std::optional<Block> block_;
  std::vector<Cell> cells_;
  std::vector<double> factors_;  // row-major: factor(i, j) is the form factor from cell i to cell j
};

}  // namespace relight::check
