#include "common/image/metrics.h"
#include "common/finite.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/image/noise_statistics.h"
#include "common/image/ssim.h"
#include "common/run/error.h"

namespace relight {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
// Keeps relmse finite where the reference is black.
constexpr double relmse_offset = 0.01;
// Rec. 709 weights of linear sRGB primaries.
constexpr glm::dvec3 luminance_weights{0.2126, 0.7152, 0.0722};

// One pixel in double: approximation, reference and the standard deviation of the reference's noise.
struct Sample {
  glm::dvec3 a, r, sigma;
};

// Exposed and clamped to [0,1]; a clamped value has no noise.
Sample exposed(const Sample& s, double exposure) {
  Sample result{glm::clamp(exposure * s.a, 0.0, 1.0), glm::clamp(exposure * s.r, 0.0, 1.0),
                exposure * s.sigma};
  for (int c = 0; c < 3; ++c)
    if (exposure * s.r[c] > 1.0 || exposure * s.r[c] < 0.0) result.sigma[c] = 0.0;
  return result;
}

// A metric's value, floor and half width.
struct Estimate {
  double value = 0, floor = 0, half_width = 0;
};

// Sums for q = sum d^2 / sum r^2 with d = A - R, and the noise of q. With n_c = sigma_c z a pixel's part of
// the first sum changes by -2 (sigma.d) z + (sigma.sigma) z^2 and that of the second by 2 (sigma.r) z.
class SquareSums {
 public:
  void add(const Sample& s) {
    const glm::dvec3 d = s.a - s.r;
    const double noise = glm::dot(s.sigma, s.sigma), along_d = glm::dot(s.sigma, d),
                 along_r = glm::dot(s.sigma, s.r);
    difference_ += glm::dot(d, d), reference_ += glm::dot(s.r, s.r);
    noise_ += noise, noise_squares_ += noise * noise;
    dd_ += along_d * along_d, dr_ += along_d * along_r, rr_ += along_r * along_r;
  }
  // |A-R|_2 / |R|_2
  Estimate relative() const {
    if (reference_ > 0.0) return root(difference_ / reference_, reference_, difference_ / reference_);
    return {difference_ > 0.0 ? infinity : 0.0, noise_ > 0.0 ? infinity : 0.0, 0.0};
  }
  // sqrt(sum d^2 / values): the denominator has no noise.
  Estimate root_mean(double values) const { return root(difference_ / values, values, 0.0); }

 private:
  // slope: minus d q / d denominator times the denominator (0: a denominator without noise). The measured d
  // contains z itself, which makes 4 sum (sigma.(d + slope r))^2 twice as large as it should be where d is
  // noise only: one chi-square part is taken off, and one is the least that must remain.
  Estimate root(double q, double denominator, double slope) const {
    const double chi_square = 2.0 * (1.0 - slope) * (1.0 - slope) * noise_squares_;
    const double linear = 4.0 * (dd_ + 2.0 * slope * dr_ + slope * slope * rr_);
    const double variance = std::max(linear - chi_square, chi_square) / (denominator * denominator);
    return {std::sqrt(q), expected_norm(noise_, noise_squares_) / std::sqrt(denominator),
            root_half_width(q, variance)};
  }
  double difference_ = 0, reference_ = 0, noise_ = 0, noise_squares_ = 0, dd_ = 0, dr_ = 0, rr_ = 0;
};

// mean d^2 f(R) over pixels and channels, f(R) = 1 / (R^2 + 0.01). Here the weight is noisy too; for A = R
// Stein's lemma gives E n^2 f(R + n) = E [v f(R + n) + v^2 f''(R + n)] exactly, with v the variance of n.
class RelativeSquareMean {
 public:
  void add(const Sample& s) {
    const glm::dvec3 d = s.a - s.r, v = s.sigma * s.sigma, weight = 1.0 / (s.r * s.r + relmse_offset);
    const glm::dvec3 curvature = (6.0 * s.r * s.r - 2.0 * relmse_offset) * weight * weight * weight;
    const double noise = glm::dot(v, weight);
    const double slope = glm::dot(s.sigma, -2.0 * d * weight - 2.0 * s.r * d * d * weight * weight);
    value_ += glm::dot(d * d, weight), floor_ += noise + glm::dot(v * v, curvature);
    noise_squares_ += noise * noise, linear_ += slope * slope;
  }
  Estimate mean(double values) const {
    const double variance = std::max(linear_ - 2.0 * noise_squares_, 2.0 * noise_squares_);
    // Noise beyond the offset on a black reference could turn the estimate's sign.
    return {value_ / values, std::max(floor_, 0.0) / values,
            normal_quantile_95 * std::sqrt(variance) / values};
  }

 private:
  double value_ = 0, floor_ = 0, noise_squares_ = 0, linear_ = 0;
};

// mean(A - R) / mean(R) = sum A / sum R - 1: noise reaches it through sum R alone.
class BiasSums {
 public:
  void add(const Sample& s) {
    const glm::dvec3 one(1.0);
    approximation_ += glm::dot(s.a, one), reference_ += glm::dot(s.r, one),
        difference_ += glm::dot(s.a - s.r, one);
    const double sigma = glm::dot(s.sigma, one);
    variance_ += sigma * sigma;
  }
  Estimate bias() const {
    if (reference_ == 0.0)
      return {difference_ == 0.0 ? 0.0 : std::copysign(infinity, difference_),
              variance_ > 0.0 ? infinity : 0.0, 0.0};
    const double sd = std::sqrt(variance_) / std::abs(reference_);
    // The floor is for A = R, where the slope |sum A / sum R| is 1.
    return {difference_ / reference_, std::sqrt(2.0 / M_PI) * sd,
            normal_quantile_95 * sd * std::abs(approximation_ / reference_)};
  }

 private:
  double approximation_ = 0, reference_ = 0, difference_ = 0, variance_ = 0;
};

// Largest |A-R| of any channel; its half width is that of the channel where it was found.
class Maximum {
 public:
  void add(const Sample& s) {
    sigmas_.push_back(std::max({s.sigma.x, s.sigma.y, s.sigma.z}));
    for (int c = 0; c < 3; ++c)
      if (const double d = std::abs(s.a[c] - s.r[c]); d > value_) value_ = d, sigma_there_ = s.sigma[c];
  }
  Estimate maximum() const { return {value_, expected_maximum(sigmas_), normal_quantile_95 * sigma_there_}; }

 private:
  double value_ = 0, sigma_there_ = 0;
  std::vector<double> sigmas_;
};

// Luminance of exposed and clamped images, with its noise.
class LuminancePlanes {
 public:
  LuminancePlanes(int width, int height)
      : a_{width, height, {}}, r_{width, height, {}}, variance_{width, height, {}} {}
  void add(const Sample& s) {
    a_.values.push_back(glm::dot(luminance_weights, s.a)),
        r_.values.push_back(glm::dot(luminance_weights, s.r));
    const double sigma = glm::dot(luminance_weights, s.sigma);
    variance_.values.push_back(sigma * sigma);
  }
  Estimate similarity() const {
    const SsimReport report = structural_similarity(a_, r_, variance_);
    return {report.value, report.noise_floor, report.half_width};
  }

 private:
  Plane a_, r_, variance_;
};

constexpr double MetricSet::*all_metrics[] = {&MetricSet::relative,     &MetricSet::relative_edges_out,
                                              &MetricSet::relative_hdr, &MetricSet::rmse,
                                              &MetricSet::relmse,       &MetricSet::bias,
                                              &MetricSet::ssim,         &MetricSet::max};

MetricSet undefined_metrics() {
  MetricSet metrics;
  for (const auto field : all_metrics) metrics.*field = nan;
  return metrics;
}

void set(ErrorReport& report, double MetricSet::*field, const Estimate& estimate) {
  report.value.*field = estimate.value;
  report.noise_floor.*field = estimate.floor;
  report.half_width.*field = estimate.half_width;
}

void require_same_size(const Image& a, const Image& r, const Image& variance, size_t edges) {
  if (r.width < 1 || r.height < 1) fail("can't compare images without pixels");
  if (a.width != r.width || a.height != r.height)
    fail("can't compare an image of {} x {} pixels with a reference of {} x {}", a.width, a.height, r.width,
         r.height);
  if (!variance.pixels.empty() && (variance.width != r.width || variance.height != r.height))
    fail("the variance image has {} x {} pixels, its reference {} x {}", variance.width, variance.height,
         r.width, r.height);
  if (edges != 0 && edges != r.pixels.size())
    fail("the edge mask has {} pixels, the reference {}", edges, r.pixels.size());
}

int64_t count_non_finite(const Image& a, const Image& r) {
  int64_t count = 0;
  for (size_t i = 0; i < r.pixels.size(); ++i) count += !finite(a.pixels[i]) || !finite(r.pixels[i]);
  return count;
}

bool usable(const Image& variance) {
  return std::all_of(variance.pixels.begin(), variance.pixels.end(), [](const glm::vec3& v) {
    return finite(v) && v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f;
  });
}

// `variance` is empty or usable.
void measure(ErrorReport& report, const Image& a, const Image& r, const Image& variance,
             const std::vector<uint8_t>& edge, double exposure) {
  SquareSums clamped, clamped_edges_out, hdr;
  RelativeSquareMean relmse;
  BiasSums bias;
  Maximum maximum;
  LuminancePlanes luminance(r.width, r.height);
  size_t edges = 0;
  for (size_t i = 0; i < r.pixels.size(); ++i) {
    const glm::dvec3 sigma =
        variance.pixels.empty() ? glm::dvec3(0.0) : glm::sqrt(glm::dvec3(variance.pixels[i]));
    const Sample sample{a.pixels[i], r.pixels[i], sigma};
    const Sample seen = exposed(sample, exposure);
    const bool is_edge = !edge.empty() && edge[i] != 0;
    edges += is_edge;
    if (!is_edge) clamped_edges_out.add(seen);
    clamped.add(seen), luminance.add(seen);
    hdr.add(sample), relmse.add(sample), bias.add(sample), maximum.add(sample);
  }
  const double pixels = static_cast<double>(r.pixels.size()), values = 3.0 * pixels;
  report.edge_share = static_cast<double>(edges) / pixels;
  set(report, &MetricSet::relative, clamped.relative());
  set(report, &MetricSet::relative_edges_out,
      edges == r.pixels.size() ? Estimate{nan, nan, nan} : clamped_edges_out.relative());
  set(report, &MetricSet::relative_hdr, hdr.relative());
  set(report, &MetricSet::rmse, hdr.root_mean(values));
  set(report, &MetricSet::relmse, relmse.mean(values));
  set(report, &MetricSet::bias, bias.bias());
  set(report, &MetricSet::ssim, luminance.similarity());
  set(report, &MetricSet::max, maximum.maximum());
}

}  // namespace

ErrorReport compare_images(const Image& a, const Image& r, const Image& variance,
                           const std::vector<uint8_t>& edge, float exposure) {
  require_same_size(a, r, variance, edge.size());
  if (!(exposure > 0.0f) || !std::isfinite(exposure))
    fail("exposure {} is out of range; valid: above 0", exposure);
  ErrorReport report;
  report.non_finite = count_non_finite(a, r);
  const bool variance_usable = usable(variance);
  measure(report, a, r, variance_usable && report.non_finite == 0 ? variance : Image(), edge, exposure);
  if (report.non_finite > 0) report.value = undefined_metrics();
  if (report.non_finite > 0 || !variance_usable) report.noise_floor = report.half_width = undefined_metrics();
  return report;
}

}  // namespace relight
