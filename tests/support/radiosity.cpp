#include "tests/support/radiosity.h"

#include <algorithm>
#include <cmath>

namespace relight::check {

namespace {

// Points a side on each cell of a pair that the block may separate.
constexpr int pair_points = 4;
// Points a side on a cell for the shadow of a point light, and parts a side for the view from one point.
constexpr int shadow_points = 8, gather_parts = 16;

glm::dvec3 low(const Rectangle& r) { return glm::min(r.at(0, 0), r.at(1, 1)); }
glm::dvec3 high(const Rectangle& r) { return glm::max(r.at(0, 0), r.at(1, 1)); }

int count(const glm::dvec3& edge, double cell) {
  return std::max(1, static_cast<int>(std::lround(glm::length(edge) / cell)));
}

// Part (i, j) of n x m equal ones.
Rectangle part(const Rectangle& r, int i, int n, int j, int m) {
  return {r.at(static_cast<double>(i) / n, static_cast<double>(j) / m), r.a / static_cast<double>(n),
          r.b / static_cast<double>(m)};
}

glm::dvec3 point(const Rectangle& r, int index, int side) {
  return r.at((index % side + 0.5) / side, (index / side + 0.5) / side);
}

}  // namespace

bool Block::hides(const glm::dvec3& p, const glm::dvec3& q) const {
  // Slabs, shrunk so that points on the faces aren't hidden by them.
  double enter = 0.0, leave = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double from = lo[axis] + 1e-9, to = hi[axis] - 1e-9, d = q[axis] - p[axis];
    if (d == 0.0) {
      if (p[axis] <= from || p[axis] >= to) return false;
      continue;
    }
    const double t0 = (from - p[axis]) / d, t1 = (to - p[axis]) / d;
    enter = std::max(enter, std::min(t0, t1)), leave = std::min(leave, std::max(t0, t1));
  }
  return enter < leave;
}

RadiosityRoom::RadiosityRoom(const std::vector<Surface>& surfaces, const std::optional<Block>& block,
                             double cell)
    : block_(block) {
  for (const Surface& s : surfaces) {
    const int n = count(s.shape.a, cell), m = count(s.shape.b, cell);
    for (int i = 0; i < n * m; ++i)
      cells_.push_back({part(s.shape, i % n, n, i / n, m), s.shape.normal(), s.albedo, s.emission});
  }
  factors_.assign(cells_.size() * cells_.size(), 0.0);
  for (size_t i = 0; i < cells_.size(); ++i)
    for (size_t j = 0; j < i; ++j) {
      double f = form_factor(cells_[i].shape, cells_[j].shape);
      if (f > 0.0) f *= visible_fraction(cells_[i], cells_[j]);
      factor(i, j) = f;
      factor(j, i) = f * cells_[i].shape.area() / cells_[j].shape.area();
    }
}

bool RadiosityRoom::may_hide(const Rectangle& a, const Rectangle& b) const {
  if (!block_) return false;
  const glm::dvec3 lo = glm::min(low(a), low(b)), hi = glm::max(high(a), high(b));
  return glm::all(glm::lessThan(lo, block_->hi - 1e-9)) && glm::all(glm::greaterThan(hi, block_->lo + 1e-9));
}

double RadiosityRoom::visible_fraction(const Cell& a, const Cell& b) const {
  if (!may_hide(a.shape, b.shape)) return 1.0;
  double visible = 0.0, all = 0.0;
  for (int i = 0; i < pair_points * pair_points; ++i)
    for (int j = 0; j < pair_points * pair_points; ++j) {
      const glm::dvec3 p = point(a.shape, i, pair_points), q = point(b.shape, j, pair_points), d = q - p;
      const double r2 = glm::dot(d, d);
      const double kernel = -glm::dot(a.normal, d) * glm::dot(b.normal, d) / (r2 * r2);
      all += kernel;
      if (!block_->hides(p, q)) visible += kernel;
    }
  return visible / all;
}

double RadiosityRoom::form_factor_sum(size_t i) const {
  double sum = 0.0;
  for (size_t j = 0; j < cells_.size(); ++j) sum += factor(i, j);
  return sum;
}

bool RadiosityRoom::hidden(size_t i) const {
  const glm::dvec3 p = cells_[i].shape.at(0.5, 0.5) + 1e-6 * cells_[i].normal;
  return block_ && block_->hides(p, p + 1e-6 * cells_[i].normal);
}

Radiosities RadiosityRoom::emitted() const {
  Radiosities b;
  for (const Cell& c : cells_) b.push_back(M_PI * c.emission);
  return b;
}

Radiosities RadiosityRoom::lit_by(const glm::dvec3& position, const glm::dvec3& intensity) const {
  Radiosities b;
  for (const Cell& c : cells_) {
    b.emplace_back(0.0);
    if (!(glm::dot(position - c.shape.corner, c.normal) > 0.0)) continue;
    int visible = 0;
    for (int i = 0; i < shadow_points * shadow_points; ++i)
      visible += !block_ || !block_->hides(position, point(c.shape, i, shadow_points));
    // Power through the cell's solid angle, spread over its area.
    const double fraction = static_cast<double>(visible) / (shadow_points * shadow_points);
    b.back() = c.albedo * intensity * (solid_angle(position, c.shape) / c.shape.area() * fraction);
  }
  return b;
}

Radiosities RadiosityRoom::bounce(const Radiosities& b) const {
  Radiosities result(b.size(), glm::dvec3(0.0));
  for (size_t i = 0; i < b.size(); ++i) {
    for (size_t j = 0; j < b.size(); ++j) result[i] += factor(i, j) * b[j];
    result[i] *= cells_[i].albedo;
  }
  return result;
}

Radiosities RadiosityRoom::solve(const Radiosities& source) const {
  Radiosities b = source;
  double largest = 0.0, change = 1.0;
  while (change > 1e-12 * largest) {
    change = 0.0;
    for (size_t i = 0; i < b.size(); ++i) {
      glm::dvec3 arriving(0.0);
      for (size_t j = 0; j < b.size(); ++j) arriving += factor(i, j) * b[j];
      const glm::dvec3 next = source[i] + cells_[i].albedo * arriving;
      change = std::max(change, glm::length(next - b[i])), largest = std::max(largest, glm::length(next));
      b[i] = next;
    }
  }
  return b;
}

glm::dvec3 RadiosityRoom::irradiance(const glm::dvec3& p, const glm::dvec3& normal,
                                     const Radiosities& b) const {
  glm::dvec3 sum(0.0);
  for (size_t j = 0; j < cells_.size(); ++j) {
    const Cell& c = cells_[j];
    if (b[j] == glm::dvec3(0.0) || !(glm::dot(p - c.shape.corner, c.normal) > 1e-12)) continue;
    if (!(glm::dot(c.shape.at(0.5, 0.5) - p, normal) > 1e-12)) continue;
    const int parts = may_hide({p, {}, {}}, c.shape) ? gather_parts : 1;
    for (int i = 0; i < parts * parts; ++i) {
      const Rectangle r = part(c.shape, i % parts, parts, i / parts, parts);
      if (parts > 1 && block_->hides(p, r.at(0.5, 0.5))) continue;
      sum += form_factor(p, normal, r) * b[j];
    }
  }
  return sum;
}

}  // namespace relight::check
