#include "tests/support/form_factors.h"

#include <array>
#include <cmath>

namespace relight::check {

namespace {

struct Interval {
  double ends[2];
};

Interval extent(const Rectangle& r, int axis) {
  const double p = r.corner[axis], q = r.corner[axis] + r.a[axis] + r.b[axis];
  return {{std::min(p, q), std::max(p, q)}};
}

int axis_of_normal(const Rectangle& r) {
  const glm::dvec3 n = glm::abs(r.normal());
  return n.x > 0.5 ? 0 : n.y > 0.5 ? 1 : 2;
}

double x_log_x(double factor, double x) { return x > 0.0 ? factor * std::log(x) : 0.0; }

// dy w atan(dy / w), the antiderivative both cases share; 0 at w = 0.
double arc(double dy, double w) { return w > 0.0 ? dy * w * std::atan(dy / w) : 0.0; }

// Fourth antiderivatives of the kernel cos cos / (pi r^2), up to the factor 1 / (2 pi).
double parallel_term(double dx, double dy, double z) {
  return arc(dy, std::hypot(dx, z)) + arc(dx, std::hypot(dy, z)) -
         0.5 * x_log_x(z * z, dx * dx + dy * dy + z * z);
}
double perpendicular_term(double x, double xi, double dy) {
  const double w2 = x * x + xi * xi;
  return arc(dy, std::sqrt(w2)) - 0.25 * x_log_x(w2 - dy * dy, w2 + dy * dy);
}

// Alternating sum over the ends of four intervals.
template <typename Term>
double alternating(const Interval& p, const Interval& q, const Interval& r, const Interval& s, Term term) {
  double sum = 0.0;
  for (int i = 0; i < 16; ++i) {
    const int bit[4] = {i & 1, (i >> 1) & 1, (i >> 2) & 1, (i >> 3) & 1};
    const double sign = (bit[0] + bit[1] + bit[2] + bit[3]) % 2 ? -1.0 : 1.0;
    sum += sign * term(p.ends[bit[0]], q.ends[bit[1]], r.ends[bit[2]], s.ends[bit[3]]);
  }
  return sum;
}

// Distances of r's ends from a plane across `axis`, in ascending order.
Interval distances(const Rectangle& r, int axis, double plane) {
  const Interval e = extent(r, axis);
  const double p = std::abs(e.ends[0] - plane), q = std::abs(e.ends[1] - plane);
  return {{std::min(p, q), std::max(p, q)}};
}

// Is the middle of `to` in front of `from`?
bool in_front(const Rectangle& from, const Rectangle& to) {
  return glm::dot(to.at(0.5, 0.5) - from.corner, from.normal()) > 1e-12;
}

// Unit vectors aside, the sum of angles times plane normals of Lambert's formula.
glm::dvec3 edge_vector(const glm::dvec3& p, const glm::dvec3& q) {
  const glm::dvec3 cross = glm::cross(p, q);
  const double length = glm::length(cross);
  return length > 0.0 ? cross * (std::atan2(length, glm::dot(p, q)) / length) : glm::dvec3(0.0);
}

double triangle_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2.0 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))), below);
}

}  // namespace

double form_factor(const Rectangle& from, const Rectangle& to) {
  if (!in_front(from, to) || !in_front(to, from)) return 0.0;
  const int n = axis_of_normal(from), m = axis_of_normal(to);
  const double scale = 1.0 / (2.0 * M_PI * from.area());
  if (n == m) {
    const int x = (n + 1) % 3, y = (n + 2) % 3;
    const double z = to.corner[n] - from.corner[n];
    return scale * alternating(extent(from, x), extent(to, x), extent(from, y), extent(to, y),
                               [z](double x1, double x2, double y1, double y2) {
                                 return parallel_term(x1 - x2, y1 - y2, z);
                               });
  }
  const int y = 3 - n - m;  // along the line where the planes meet
  return scale * alternating(distances(from, m, to.corner[m]), distances(to, n, from.corner[n]),
                             extent(from, y), extent(to, y), [](double x, double xi, double y1, double y2) {
                               return perpendicular_term(x, xi, y1 - y2);
                             });
}

double form_factor(const glm::dvec3& point, const glm::dvec3& n, std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0.0);
  for (size_t i = 0; i < polygon.size(); ++i)
    sum += edge_vector(polygon[i] - point, polygon[(i + 1) % polygon.size()] - point);
  return std::abs(glm::dot(sum, n)) / (2.0 * M_PI);
}

double form_factor(const glm::dvec3& point, const glm::dvec3& n, const Rectangle& r) {
  const std::array<glm::dvec3, 4> corners = {r.at(0, 0), r.at(1, 0), r.at(1, 1), r.at(0, 1)};
  return form_factor(point, n, corners);
}

double solid_angle(const glm::dvec3& point, const Rectangle& r) {
  const glm::dvec3 p = r.at(0, 0) - point, q = r.at(1, 0) - point, s = r.at(1, 1) - point,
                   t = r.at(0, 1) - point;
  return triangle_solid_angle(p, q, s) + triangle_solid_angle(p, s, t);
}

}  // namespace relight::check
