// Analytic form factors in double precision: fractions of the light leaving one place that arrive at another,
// without obstacles.
#pragma once

#include <span>

#include <glm/glm.hpp>

namespace relight::check {

// An axis-aligned rectangle: corner, corner + a, corner + a + b, corner + b. Its front is where
// cross(a, b) points.
struct Rectangle {
  glm::dvec3 corner, a, b;
  glm::dvec3 at(double u, double v) const { return corner + u * a + v * b; }
  glm::dvec3 normal() const { return glm::normalize(glm::cross(a, b)); }
  double area() const { return glm::length(glm::cross(a, b)); }
};

// Fraction of the diffuse light leaving the front of `from` that reaches the front of `to`. `to` lies wholly
// in front of the plane of `from` or wholly behind it, and the other way round. Form factors of rectangles
// with parallel edges in parallel and in perpendicular planes: Ehlert and Smith, "View Factors for
// Perpendicular and Parallel Rectangular Plates", 1993.
double form_factor(const Rectangle& from, const Rectangle& to);

// Fraction of the irradiance of a point with unit normal n that a polygon of uniform radiance fills; the
// polygon lies above the point's horizon. Lambert's formula: the sum over the edges of the angle seen times
// the cosine between n and the normal of the edge's plane, over 2 pi. Either orientation gives the same.
double form_factor(const glm::dvec3& point, const glm::dvec3& n, std::span<const glm::dvec3> polygon);
double form_factor(const glm::dvec3& point, const glm::dvec3& n, const Rectangle& rectangle);

// Solid angle of a rectangle from a point [sr] (van Oosterom and Strackee, 1983, for its two triangles).
double solid_angle(const glm::dvec3& point, const Rectangle& rectangle);

}  // namespace relight::check
