#include "common/image/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

#include "common/image/noise_statistics.h"

namespace relight {

namespace {

constexpr int radius = 5;
constexpr double window_sigma = 1.5;
constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;

using Kernel = std::array<double, 2 * radius + 1>;

// Gaussian weights of one axis, to the given power (2 for sums of squared weights), before normalisation.
Kernel kernel_of(int power) {
  Kernel kernel{};
  for (int i = -radius; i <= radius; ++i)
    kernel[static_cast<size_t>(i + radius)] =
        std::pow(std::exp(-0.5 * i * i / (window_sigma * window_sigma)), power);
  return kernel;
}

// Sum of the kernel over the positions inside [0, size) around `centre`.
double weight_inside(const Kernel& kernel, int centre, int size) {
  double sum = 0.0;
  for (int i = std::max(-radius, -centre); i <= std::min(radius, size - 1 - centre); ++i)
    sum += kernel[static_cast<size_t>(i + radius)];
  return sum;
}

// One axis of the separable filter; `stride` steps along the axis, `across` from one line to the next.
std::vector<double> filter_axis(const std::vector<double>& in, const Kernel& kernel, int size, int lines,
                                size_t stride, size_t across) {
  std::vector<double> out(in.size());
  for (int line = 0; line < lines; ++line)
    for (int at = 0; at < size; ++at) {
      const size_t base = static_cast<size_t>(line) * across;
      double sum = 0.0;
      for (int i = std::max(-radius, -at); i <= std::min(radius, size - 1 - at); ++i)
        sum += kernel[static_cast<size_t>(i + radius)] * in[base + static_cast<size_t>(at + i) * stride];
      out[base + static_cast<size_t>(at) * stride] = sum;
    }
  return out;
}

// Sums over windows of one image size, with the border's normalisation.
class Window {
 public:
  Window(int width, int height)
      : width_(width), height_(height), norm_(static_cast<size_t>(width) * static_cast<size_t>(height)) {
    const Kernel kernel = kernel_of(1);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        norm_[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] =
            weight_inside(kernel, x, width) * weight_inside(kernel, y, height);
  }
  // sum_j w_ij f_j for every window i.
  std::vector<double> mean(const std::vector<double>& f) const {
    std::vector<double> sums = filter(f, kernel_of(1));
    for (size_t i = 0; i < sums.size(); ++i) sums[i] /= norm_[i];
    return sums;
  }
  // sum_j w_ij^2 f_j for every window i.
  std::vector<double> squared_weights(const std::vector<double>& f) const {
    std::vector<double> sums = filter(f, kernel_of(2));
    for (size_t i = 0; i < sums.size(); ++i) sums[i] /= norm_[i] * norm_[i];
    return sums;
  }
  // sum_i w_ij f_i for every pixel j: the transpose of mean().
  std::vector<double> spread(std::vector<double> f) const {
    for (size_t i = 0; i < f.size(); ++i) f[i] /= norm_[i];
    return filter(f, kernel_of(1));
  }

 private:
  std::vector<double> filter(const std::vector<double>& f, const Kernel& kernel) const {
    const size_t row = static_cast<size_t>(width_);
    return filter_axis(filter_axis(f, kernel, width_, height_, 1, row), kernel, height_, width_, row, 1);
  }
  int width_, height_;
  std::vector<double> norm_;
};

std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), std::multiplies<>());
  return result;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// First and second moments of every window.
struct Moments {
  std::vector<double> mx, my, vx, vy, cov;
};

Moments moments_of(const Window& window, const Plane& x, const Plane& y) {
  Moments m{window.mean(x.values), window.mean(y.values), window.mean(product(x.values, x.values)),
            window.mean(product(y.values, y.values)), window.mean(product(x.values, y.values))};
  for (size_t i = 0; i < m.mx.size(); ++i) {
    m.vx[i] = std::max(m.vx[i] - m.mx[i] * m.mx[i], 0.0);
    m.vy[i] = std::max(m.vy[i] - m.my[i] * m.my[i], 0.0);
    m.cov[i] -= m.mx[i] * m.my[i];
  }
  return m;
}

// Equation 13 is luminance (l_top / l_bottom) times contrast and structure (s_top / s_bottom).
struct Factors {
  double l_top, l_bottom, s_top, s_bottom;
  double ssim() const { return l_top * s_top / (l_bottom * s_bottom); }
};

Factors factors_of(const Moments& m, size_t i) {
  return {2.0 * m.mx[i] * m.my[i] + c1, m.mx[i] * m.mx[i] + m.my[i] * m.my[i] + c1, 2.0 * m.cov[i] + c2,
          m.vx[i] + m.vy[i] + c2};
}

// Noise of variance v adds sum w^2 v to the expected square of the window's mean and sum w v - sum w^2 v to
// its expected variance; y's own variance already holds that part, so x's is what is left of it.
double expected_under_noise(const Window& window, const Moments& m, const std::vector<double>& variance) {
  const std::vector<double> in_pixels = window.mean(variance), in_mean = window.squared_weights(variance);
  double sum = 0.0;
  for (size_t i = 0; i < m.my.size(); ++i) {
    const double noise = in_pixels[i] - in_mean[i];
    const double square = std::max(m.my[i] * m.my[i] - in_mean[i], 0.0),
                 spread = std::max(m.vy[i] - noise, 0.0);
    const Factors f{2.0 * square + c1, 2.0 * square + in_mean[i] + c1, 2.0 * spread + c2,
                    2.0 * spread + noise + c2};
    sum += f.ssim();
  }
  return sum / static_cast<double>(m.my.size());
}

// Variance of the mean similarity to first order: sum over pixels of (derivative by y)^2 times its variance.
// For one window d ssim / d y_j = w_j (a + b x_j + c y_j), so the sums over windows are three filters.
double first_order_variance(const Window& window, const Moments& m, const Plane& x, const Plane& y,
                            const std::vector<double>& variance) {
  const size_t n = m.mx.size();
  std::vector<double> a(n), b(n), c(n);
  for (size_t i = 0; i < n; ++i) {
    const Factors f = factors_of(m, i);
    const double ssim = f.ssim();
    // From cov = sum w x y - mx my and vy = sum w y^2 - my^2.
    b[i] = 2.0 * f.l_top / (f.l_bottom * f.s_bottom);
    c[i] = -2.0 * ssim / f.s_bottom;
    a[i] = ssim * (-2.0 * m.my[i] / f.l_bottom) + 2.0 * m.mx[i] * f.s_top / (f.l_bottom * f.s_bottom) -
           b[i] * m.mx[i] - c[i] * m.my[i];
  }
  a = window.spread(a), b = window.spread(b), c = window.spread(c);
  double sum = 0.0;
  for (size_t j = 0; j < n; ++j) {
    const double slope = (a[j] + b[j] * x.values[j] + c[j] * y.values[j]) / static_cast<double>(n);
    sum += slope * slope * variance[j];
  }
  return sum;
}

}  // namespace

SsimReport structural_similarity(const Plane& x, const Plane& y, const Plane& y_variance) {
  const Window window(x.width, x.height);
  const Moments m = moments_of(window, x, y);
  std::vector<double> similarity(m.mx.size());
  for (size_t i = 0; i < similarity.size(); ++i) similarity[i] = factors_of(m, i).ssim();
  SsimReport report;
  report.value = mean_of(similarity);
  const auto& variance = y_variance.values;
  if (std::none_of(variance.begin(), variance.end(), [](double v) { return v > 0.0; })) return report;
  report.noise_floor = expected_under_noise(window, m, variance);
  report.half_width = normal_quantile_95 * std::sqrt(first_order_variance(window, m, x, y, variance));
  return report;
}

}  // namespace relight
