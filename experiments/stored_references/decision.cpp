#include "experiments/stored_references/decision.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/run/error.h"
#include "experiments/stored_references/significance.h"

namespace relight {

namespace {

constexpr double two_sigma = 0.04550026389635842, three_sigma = 0.002699796063260207;  // two-sided

double mean_channel(const glm::vec3& v) {
  return (static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z)) / 3.0;
}

// Variance of the mean channel: its channels share their paths, so standard deviations add.
double variance_of_mean_channel(const glm::vec3& v) {
  const double sum = std::sqrt(static_cast<double>(v.x)) + std::sqrt(static_cast<double>(v.y)) +
                     std::sqrt(static_cast<double>(v.z));
  return sum * sum / 9.0;
}

// A pixel that its rare bright paths have missed so far has a small variance and is dark: alone it would look
// certain. No pixel is taken to be surer than its tile is on average.
Image floored_by_tile(const Image& variance) {
  const Image tiles = block_means(variance, tile_side);
  Image result = variance;
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      result.at(x, y) = glm::max(result.at(x, y), tiles.at(x / tile_side, y / tile_side));
  return result;
}

// p-value of "fresh and stored estimate the same number". A picture of few samples that has missed rare
// bright paths is both too dark and too sure of it; so neither picture is taken to be surer than the other
// one's variance predicts for its number of samples. (Stratification gains faster than that, which makes the
// test milder, not wrong.)
double p_value(MeasuredMean fresh, MeasuredMean stored, const PictureStatistics& f,
               const PictureStatistics& s) {
  const double ratio = static_cast<double>(s.samples_per_pixel) / static_cast<double>(f.samples_per_pixel);
  const double of_fresh = fresh.variance;
  fresh.variance = std::max(fresh.variance, stored.variance * ratio);
  stored.variance = std::max(stored.variance, of_fresh / ratio);
  return welch_p_value(fresh, stored);
}

// p-values of pixels, channel by channel.
class PixelPValues {
 public:
  PixelPValues(const PictureStatistics& fresh, const PictureStatistics& stored)
      : fresh_(fresh),
        stored_(stored),
        fresh_variance_(floored_by_tile(fresh.pixels.variance)),
        stored_variance_(floored_by_tile(stored.pixels.variance)) {}
  double operator()(size_t pixel, int channel) const {
    return p_value(measured(fresh_, fresh_variance_, pixel, channel),
                   measured(stored_, stored_variance_, pixel, channel), fresh_, stored_);
  }

 private:
  static MeasuredMean measured(const PictureStatistics& p, const Image& variance, size_t i, int c) {
    return {static_cast<double>(p.pixels.mean.pixels[i][c]), static_cast<double>(variance.pixels[i][c]),
            p.batches};
  }
  const PictureStatistics &fresh_, &stored_;
  Image fresh_variance_, stored_variance_;
};

double tile_p_value(const PictureStatistics& fresh, const PictureStatistics& stored, size_t tile) {
  const auto measured = [&](const PictureStatistics& p) {
    return MeasuredMean{mean_channel(p.tiles.mean.pixels[tile]),
                        variance_of_mean_channel(p.tiles.variance.pixels[tile]), p.batches};
  };
  return p_value(measured(fresh), measured(stored), fresh, stored);
}

Question direct_question(const Image& fresh, const Image& stored) {
  // Another compiler or processor may move a few sub-pixels across the edge of a shadow.
  constexpr double tolerance = 1e-3, most_pixels = 0.005, most_bias = 2e-3;
  size_t different = 0;
  double sum = 0.0, change = 0.0;
  for (size_t i = 0; i < stored.pixels.size(); ++i) {
    const glm::vec3 d = fresh.pixels[i] - stored.pixels[i];
    different += !(glm::length(d) <= tolerance * glm::length(stored.pixels[i]));
    sum += mean_channel(stored.pixels[i]);
    change += mean_channel(d);
  }
  const double share = static_cast<double>(different) / static_cast<double>(stored.pixels.size());
  const double bias = sum > 0.0 ? change / sum : (change == 0.0 ? 0.0 : 1.0);
  const bool same = share <= most_pixels && std::abs(bias) <= most_bias;
  return {"direct", same ? 1.0 : 0.0,
          fmt::format("{:.2f} % of the pixels differ, mean {:+.4f} %", 100.0 * share, 100.0 * bias)};
}

Question pixel_question(const PictureStatistics& fresh, const PictureStatistics& stored) {
  const PixelPValues p_values(fresh, stored);
  double least = 1.0;
  size_t where = 0;
  for (size_t i = 0; i < stored.pixels.mean.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (const double p = p_values(i, c); p < least) least = p, where = i;
  const size_t width = static_cast<size_t>(stored.direct.width);
  const int tests = static_cast<int>(3 * stored.pixels.mean.pixels.size());
  return {"pixels", sidak_p_value(least, tests),
          fmt::format("largest difference {:.1f} standard errors at pixel ({}, {})", equivalent_sigmas(least),
                      where % width, where / width)};
}

Question tile_question(const PictureStatistics& fresh, const PictureStatistics& stored, double sigmas,
                       double expected) {
  const int tiles = static_cast<int>(stored.tiles.mean.pixels.size());
  int beyond = 0;
  for (size_t i = 0; i < stored.tiles.mean.pixels.size(); ++i)
    beyond += tile_p_value(fresh, stored, i) < expected;
  return {fmt::format("tiles beyond {:.0f}", sigmas), binomial_upper_tail(beyond, tiles, expected),
          fmt::format("{} of {} tiles, {:.1f} expected", beyond, tiles, expected * tiles)};
}

Question picture_question(const PictureStatistics& fresh, const PictureStatistics& stored) {
  double least = 1.0;
  for (int c = 0; c < 3; ++c) {
    const auto measured = [&](const PictureStatistics& p) {
      return MeasuredMean{static_cast<double>(p.whole.mean.pixels[0][c]),
                          static_cast<double>(p.whole.variance.pixels[0][c]), p.batches};
    };
    least = std::min(least, p_value(measured(fresh), measured(stored), fresh, stored));
  }
  const double now = mean_channel(fresh.whole.mean.pixels[0]),
               before = mean_channel(stored.whole.mean.pixels[0]);
  return {"picture", sidak_p_value(least, 3),
          fmt::format("mean of indirect light {:+.3f} %, {:.1f} standard errors",
                      before != 0.0 ? 100.0 * (now / before - 1.0) : 0.0, equivalent_sigmas(least))};
}

void require_same_size(const PictureStatistics& a, const PictureStatistics& b) {
  if (a.direct.width != b.direct.width || a.direct.height != b.direct.height)
    fail("pictures of {}x{} and {}x{} pixels can't be compared", a.direct.width, a.direct.height,
         b.direct.width, b.direct.height);
}

}  // namespace

bool Decision::same() const {
  return std::all_of(questions.begin(), questions.end(),
                     [&](const Question& q) { return q.p_value >= level; });
}

std::string Decision::to_string() const {
  std::string text;
  for (const Question& q : questions)
    text += fmt::format("  {:<15} p = {:<9.3g} {}{}\n", q.name, q.p_value, q.found,
                        q.p_value < level ? "   <-- DIFFERS" : "");
  return text;
}

Decision compare_pictures(const PictureStatistics& fresh, const PictureStatistics& stored, double level) {
  require_same_size(fresh, stored);
  Decision decision;
  decision.questions = {direct_question(fresh.direct, stored.direct), pixel_question(fresh, stored),
                        tile_question(fresh, stored, 2.0, two_sigma),
                        tile_question(fresh, stored, 3.0, three_sigma), picture_question(fresh, stored)};
  decision.questions.push_back({"finite", fresh.non_finite == 0 ? 1.0 : 0.0,
                                fmt::format("{} samples were not finite", fresh.non_finite)});
  // "direct" and "finite" leave nothing to chance.
  decision.level = sidak_level(level, static_cast<int>(decision.questions.size()) - 2);
  return decision;
}

Image difference_in_sigmas(const PictureStatistics& fresh, const PictureStatistics& stored) {
  require_same_size(fresh, stored);
  const PixelPValues p_values(fresh, stored);
  Image sigmas(stored.direct.width, stored.direct.height);
  for (size_t i = 0; i < sigmas.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const bool brighter = fresh.pixels.mean.pixels[i][c] > stored.pixels.mean.pixels[i][c];
      sigmas.pixels[i][c] = static_cast<float>((brighter ? 1.0 : -1.0) * equivalent_sigmas(p_values(i, c)));
    }
  return sigmas;
}

double share_of_tiles_beyond(double sigmas, const PictureStatistics& fresh, const PictureStatistics& stored) {
  require_same_size(fresh, stored);
  size_t beyond = 0;
  for (size_t i = 0; i < stored.tiles.mean.pixels.size(); ++i)
    beyond += equivalent_sigmas(tile_p_value(fresh, stored, i)) > sigmas;
  return static_cast<double>(beyond) / static_cast<double>(stored.tiles.mean.pixels.size());
}

}  // namespace relight
