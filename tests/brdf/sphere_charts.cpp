#include "tests/brdf/sphere_charts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relight::test {

namespace {

constexpr double pi = std::numbers::pi;

// Geometric growth: scale * (e^(kt) - 1), t in [0,1].
struct Growth {
  double scale, k;
  double value(double t) const { return scale * std::expm1(k * t); }
  double derivative(double t) const { return scale * k * std::exp(k * t); }
  double inverse(double x) const { return std::log1p(x / scale) / k; }
};
const Growth angle_growth{pi / std::expm1(12.0), 12.0}, slope_growth{1e-3, std::log1p(1e9)};

glm::dmat3 frame_about(const glm::dvec3& z) {
  const glm::dvec3 other = std::abs(z.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(other, z));
  return {x, glm::cross(z, x), z};
}

double positive(double azimuth) { return azimuth < 0.0 ? azimuth + 2.0 * pi : azimuth; }

}  // namespace

SphereCharts SphereCharts::around(const std::vector<glm::vec3>& axes) {
  SphereCharts charts;
  for (const glm::vec3& axis : axes) {
    const glm::dvec3 z = glm::normalize(glm::dvec3(axis));
    // Two charts about one axis would leave a patch that neither resolves.
    const auto same = [&](const glm::dmat3& frame) { return glm::distance(frame[2], z) < 1e-4; };
    if (std::none_of(charts.frames_.begin(), charts.frames_.end(), same))
      charts.frames_.push_back(frame_about(z));
  }
  return charts;
}

SphereCharts SphereCharts::of_half_vectors(const glm::mat3& frame, const glm::vec3& wo,
                                           const glm::vec2& widths) {
  SphereCharts charts;
  charts.half_vectors_ = true;
  charts.frames_ = {glm::dmat3(frame)};
  charts.wo_ = glm::normalize(glm::dvec3(wo));
  charts.widths_ = glm::dvec2(widths);
  return charts;
}

ChartPoint SphereCharts::at(size_t chart, double t, double azimuth) const {
  const glm::dmat3& frame = frames_[chart];
  const glm::dvec2 circle(std::cos(azimuth), std::sin(azimuth));
  if (!half_vectors_) {
    const double angle = angle_growth.value(t), sine = std::sin(angle);
    return {frame * glm::dvec3(sine * circle, std::cos(angle)), 2.0 * pi * sine * angle_growth.derivative(t)};
  }
  const double r = slope_growth.value(t);
  const glm::dvec3 slopes(widths_ * circle * r, 1.0);
  const double length = glm::length(slopes);
  const glm::dvec3 h = frame * (slopes / length);
  const double cosine = glm::dot(wo_, h);
  // dwi = 4 |o.h| dh, dh = dslopes cos^3.
  const double jacobian = 4.0 * std::abs(cosine) * widths_.x * widths_.y / (length * length * length) * r *
                          slope_growth.derivative(t) * 2.0 * pi;
  return {2.0 * cosine * h - wo_, jacobian};
}

glm::dvec2 SphereCharts::coordinates(const glm::dvec3& direction) const {
  if (!half_vectors_) {
    const glm::dvec3 local = direction * frames_[0];
    return {angle_growth.inverse(std::atan2(std::hypot(local.x, local.y), local.z)),
            positive(std::atan2(local.y, local.x))};
  }
  glm::dvec3 h = (wo_ + glm::normalize(direction)) * frames_[0];
  if (h.z < 0.0) h = -h;
  const glm::dvec2 slopes = glm::dvec2(h) / std::max(h.z, 1e-300) / widths_;
  return {slope_growth.inverse(glm::length(slopes)), positive(std::atan2(slopes.y, slopes.x))};
}

double SphereCharts::integrate(const std::function<double(const glm::vec3&)>& f, int rings,
                               int sectors) const {
  const auto nearest = [&](const glm::dvec3& w) {
    size_t best = 0;
    for (size_t i = 1; i < frames_.size(); ++i)
      if (glm::dot(frames_[i][2], w) > glm::dot(frames_[best][2], w)) best = i;
    return best;
  };
  double sum = 0.0;
  for (size_t chart = 0; chart < frames_.size(); ++chart)
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < sectors; ++j) {
        const ChartPoint point = at(chart, (i + 0.5) / rings, 2.0 * pi * (j + 0.5) / sectors);
        if (frames_.size() == 1 || nearest(point.direction) == chart)
          sum += f(glm::vec3(point.direction)) * point.jacobian;
      }
  return sum / (double(rings) * sectors);
}

}  // namespace relight::test
