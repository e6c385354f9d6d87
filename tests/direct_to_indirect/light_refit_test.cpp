// The refit of kept coefficients to training lights.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "common/run/thread_limit.h"
#include "common/sampling/random.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/light_refit.h"
#include "tests/direct_to_indirect/gather_setup.h"
#include "tests/support/tiny_scenes.h"

namespace relight::direct_to_indirect {
namespace {

FinalGatherSettings short_rows() {
  FinalGatherSettings settings;
  settings.coefficients = 20;
  settings.support_exponent = 0.6f;
  return settings;
}

FinalGatherSettings exact_links(FinalGatherSettings settings, int coefficients) {
  settings.link_threshold = 0.0f;
  settings.coefficients = coefficients;
  return settings;
}

TrainingLights lights_of(const GatherSetup& s, uint32_t count, uint64_t seed) {
  return make_training_lights(s.tracer, s.buffer, s.cloud, {}, count, seed);
}

// Mean over the lights of |a - b| / |b|, a and b the answers of all rows of `rows` and `whole`.
double mean_relative_error(const SparseRows& rows, const SparseRows& whole, const TrainingLights& lights) {
  std::vector<double> difference(lights.count, 0.0), size(lights.count, 0.0);
  for (size_t i = 0; i < rows.rows(); ++i) {
    const std::vector<double> a = dense_row(rows, i), b = dense_row(whole, i);
    for (uint32_t t = 0; t < lights.count; ++t) {
      double answer_a = 0.0, answer_b = 0.0;
      for (size_t k = 0; k < a.size(); ++k) {
        const auto light = static_cast<double>(lights.response[k * lights.count + t]);
        answer_a += a[k] * light, answer_b += b[k] * light;
      }
      difference[t] += std::pow(answer_a - answer_b, 2), size[t] += answer_b * answer_b;
    }
  }
  double sum = 0.0;
  for (uint32_t t = 0; t < lights.count; ++t) sum += std::sqrt(difference[t] / size[t]);
  return sum / lights.count;
}

// The root mean square is 1 over the cloud (Parseval: the coefficients' squares sum to its size), and no
// light is negative anywhere. Red if the transform is left out or a light is normalised before its column
// factors.
TEST(TrainingLights, HaveRootMeanSquareOneAndAreDifferent) {
  const GatherSetup s(tiny::room(), 16, 12, 1024);
  std::vector<float> factors(1024);
  for (size_t j = 0; j < factors.size(); ++j) factors[j] = 0.5f + static_cast<float>(j % 7);
  const TrainingLights lights = make_training_lights(s.tracer, s.buffer, s.cloud, factors, 8, 3);
  ASSERT_EQ(lights.count, 8u);
  for (uint32_t t = 0; t < lights.count; ++t) {
    std::vector<double> column;
    double squares = 0.0;
    for (size_t k = 0; k < 1024; ++k) {
      column.push_back(lights.response[k * lights.count + t]);
      squares += column.back() * column.back();
    }
    EXPECT_NEAR(squares, 1024.0, 0.01);
    const std::vector<double> values = wavelet::inverse(column);
    EXPECT_GT(*std::min_element(values.begin(), values.end()), -1e-4);
    EXPECT_LT(*std::min_element(values.begin(), values.end()), 1e-4);  // something is in shadow or behind
    if (t > 0) {
      EXPECT_NE(lights.response[lights.count + t], lights.response[lights.count]);
    }
  }
}

// Squared weights of the lights for each 4x4 tile of an 8x8 view, by the definition in light_refit.h.
std::array<std::vector<double>, 4> squared_weights(const SparseRows& whole, const TrainingLights& lights) {
  std::array<std::vector<double>, 4> out;
  for (std::vector<double>& w : out) w.assign(lights.count, 0.0);
  for (size_t i = 0; i < 64; ++i) {
    const std::vector<double> row = dense_row(whole, i);
    for (uint32_t t = 0; t < lights.count; ++t) {
      double answer = 0.0;
      for (size_t k = 0; k < row.size(); ++k)
        answer += row[k] * static_cast<double>(lights.response[k * lights.count + t]);
      out[i / 32 * 2 + i % 8 / 4][t] += answer * answer;
    }
  }
  for (std::vector<double>& w : out) {
    const double mean = std::accumulate(w.begin(), w.end(), 0.0) / lights.count;
    for (double& x : w) x = 1.0 / (x + mean);
  }
  return out;
}

// The values of one row against the definition, in double: the gradient
// G_S W^2 (G_S^T w - G^T c) + m (w - c_S) vanishes, m_k = ridge (H_kk + a thousandth of the mean). Red if the
// ridge, a weight, the right side or a column is wrong.
TEST(LightRefit, SolvesTheRidgeRegressionOfEachRow) {
  GatherSetup s(tiny::room(), 8, 8, 256);
  const TrainingLights lights = lights_of(s, 24, 3);
  FinalGatherSettings settings = short_rows();
  settings.refit_ridge = 0.5f;
  const SparseRows whole = s.final_gather(exact_links(settings, 256)),
                   cut = s.final_gather(exact_links(settings, 20)),
                   fitted = s.final_gather(exact_links(settings, 20), {}, lights);
  const auto response = [&](uint32_t k, uint32_t t) {
    return static_cast<double>(lights.response[k * lights.count + t]);
  };
  const auto weights = squared_weights(whole, lights);
  int tested = 0;
  for (size_t i = 0; i < whole.rows(); ++i) {
    const std::vector<double>& w2 = weights[i / 32 * 2 + i % 8 / 4];
    const uint64_t first = cut.row_start[i], last = cut.row_start[i + 1];
    if (first == last) continue;
    const std::vector<double> c = dense_row(whole, i), f = dense_row(fitted, i);
    std::vector<double> error(lights.count, 0.0), squares(last - first, 0.0);
    for (uint32_t t = 0; t < lights.count; ++t)
      for (uint32_t k = 0; k < 256; ++k) error[t] += (f[k] - c[k]) * response(k, t);
    for (uint64_t e = first; e < last; ++e)
      for (uint32_t t = 0; t < lights.count; ++t)
        squares[e - first] += w2[t] * std::pow(response(cut.entries[e].column, t), 2);
    const double mean =
        std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(squares.size());
    for (uint64_t e = first; e < last; ++e) {
      ASSERT_EQ(cut.entries[e].column, fitted.entries[e].column);
      const double d =
          static_cast<double>(fitted.entries[e].value) - static_cast<double>(cut.entries[e].value);
      const double ridge = 0.5 * (squares[e - first] + 1e-3 * mean);
      double gradient = ridge * d, scale = std::abs(ridge * d);
      for (uint32_t t = 0; t < lights.count; ++t) {
        const double term = w2[t] * response(cut.entries[e].column, t) * error[t];
        gradient += term;
        scale += std::abs(term);
      }
      ASSERT_NEAR(gradient, 0.0, 1e-3 * scale + 1e-9);
      ++tested;
    }
  }
  EXPECT_GT(tested, 500);
}

// A refit small enough to try every choice: seven coefficients, of which all lanes see six.
struct SmallRefit {
  static constexpr size_t columns = 7, candidates = 6;
  static constexpr uint32_t lights = 10;
  static constexpr double ridge = 0.2;
  TrainingLights training;
  std::vector<LaneCoefficient> all;

  explicit SmallRefit(uint64_t seed) {
    training.count = lights;
    for (uint32_t k = 0; k < columns; ++k) {
      // Pairs that go together, of very different sizes: w^2 alone must not tell which one to drop.
      const float size = std::exp2(-4.0f * random_float(seed, 3, k, 0));
      for (uint32_t t = 0; t < lights; ++t)
        training.response.push_back(
            size * (random_float(seed, 1, k / 2, t) - 0.4f + 0.3f * random_float(seed, 4, k, t)));
      LaneCoefficient c{k, {}};
      c.value.fill((random_float(seed, 2, k, 0) - 0.5f) / size);  // all lanes alike
      all.push_back(c);
    }
  }

  RefitRow refitted(size_t target, size_t largest_fit = LightRefit::default_largest_fit) const {
    std::array<RefitRow, lanes> rows;
    for (uint32_t k = 0; k < candidates; ++k) rows[3].entries.push_back({k, all[k].value[3]});
    rows[3].target = target;
    LightRefit(training, static_cast<float>(ridge), largest_fit).refit(all, rows);
    return rows[3];
  }

  // All candidates, half of them in one row and half in another.
  std::vector<SparseEntry> refitted_in_halves(size_t largest_fit) const {
    std::array<RefitRow, lanes> rows;
    for (uint32_t k = 0; k < candidates; ++k) {
      RefitRow& row = rows[2 + k / (candidates / 2)];
      row.entries.push_back({k, all[k].value[0]});
      ++row.target;
    }
    LightRefit(training, static_cast<float>(ridge), largest_fit).refit(all, rows);
    rows[2].entries.insert(rows[2].entries.end(), rows[3].entries.begin(), rows[3].entries.end());
    return rows[2].entries;
  }

  double g(size_t k, size_t t) const { return static_cast<double>(training.response[k * lights + t]); }
  double c(size_t k) const { return static_cast<double>(all[k].value[0]); }

  // The objective of light_refit.h for the values w of the candidates.
  double objective(const std::array<double, candidates>& w) const {
    std::array<double, lights> answer{}, error{}, w2{};
    double mean = 0.0, sum = 0.0, squares = 0.0;
    std::array<double, candidates> h{};
    for (size_t t = 0; t < lights; ++t) {
      for (size_t k = 0; k < columns; ++k) answer[t] += c(k) * g(k, t);
      error[t] = -answer[t];
      for (size_t k = 0; k < candidates; ++k) error[t] += w[k] * g(k, t);
      mean += lanes * answer[t] * answer[t] / lights;
    }
    for (size_t t = 0; t < lights; ++t) {
      w2[t] = 1.0 / (lanes * answer[t] * answer[t] + mean);
      sum += w2[t] * error[t] * error[t];
      for (size_t k = 0; k < candidates; ++k) h[k] += w2[t] * g(k, t) * g(k, t);
    }
    for (const double x : h) squares += x / candidates;
    for (size_t k = 0; k < candidates; ++k)
      sum += ridge * (h[k] + 1e-3 * squares) * (w[k] - c(k)) * (w[k] - c(k));
    return sum;
  }

  // The least objective with w[fixed] = value, by exact minimisation along one coordinate after the other.
  double least_with(size_t fixed, double value) const {
    std::array<double, candidates> w{};
    w[fixed] = value;
    for (int sweep = 0; sweep < 2000; ++sweep)
      for (size_t k = 0; k < candidates; ++k) {
        if (k == fixed) continue;
        std::array<double, candidates> a = w, b = w, m = w;
        a[k] = -10.0, m[k] = 0.0, b[k] = 10.0;
        const double fa = objective(a), fm = objective(m), fb = objective(b);
        w[k] = 5.0 * (fa - fb) / (fa - 2.0 * fm + fb);  // vertex of the parabola
      }
    return objective(w);
  }
};

// Against trying every candidate. Red if the saliency leaves out the inverse's diagonal (w^2 alone), divides
// by the norms of its factor's columns, or drops the largest (each tried).
TEST(LightRefit, DropsTheCandidateThatCostsLeast) {
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const SmallRefit small(seed);
    const RefitRow row = small.refitted(SmallRefit::candidates - 1);
    ASSERT_EQ(row.entries.size(), SmallRefit::candidates - 1);
    std::array<double, SmallRefit::candidates> w{};
    for (const SparseEntry& e : row.entries) w[e.column] = static_cast<double>(e.value);
    double best = INFINITY;
    for (size_t k = 0; k < SmallRefit::candidates; ++k) best = std::min(best, small.least_with(k, 0.0));
    EXPECT_NEAR(small.objective(w), best, 1e-4 * best + 1e-9) << "seed " << seed;
  }
}

// Products of a row alone are those of its tile, to rounding. Red if the row takes the products of other
// columns.
TEST(LightRefit, FitsRowsOfALargeTileOneByOne) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const SmallRefit small(seed);
    const auto together = small.refitted_in_halves(SmallRefit::candidates),
               alone = small.refitted_in_halves(SmallRefit::candidates / 2);
    ASSERT_EQ(together.size(), alone.size());
    for (size_t e = 0; e < alone.size(); ++e) {
      EXPECT_EQ(together[e].column, alone[e].column);
      EXPECT_NEAR(together[e].value, alone[e].value, 1e-4f * std::abs(together[e].value));
    }
  }
}

// One entry keeps its value and the others fit what it leaves. Red if its answers are not taken off.
TEST(LightRefit, FitsTheLargestToWhatTheOthersLeave) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const SmallRefit small(seed);
    const RefitRow row = small.refitted(SmallRefit::candidates, SmallRefit::candidates - 1);
    ASSERT_EQ(row.entries.size(), SmallRefit::candidates);
    std::array<double, SmallRefit::candidates> w{};
    size_t kept = SmallRefit::candidates;
    for (const SparseEntry& e : row.entries) {
      w[e.column] = static_cast<double>(e.value);
      if (w[e.column] == small.c(e.column)) kept = e.column;
    }
    ASSERT_LT(kept, SmallRefit::candidates);
    const double least = small.least_with(kept, small.c(kept));
    EXPECT_NEAR(small.objective(w), least, 1e-4 * least + 1e-9) << "seed " << seed;
  }
}

// Nothing to learn from: the largest stay as they are.
TEST(LightRefit, KeepsTheLargestWhereNoTrainingLightReaches) {
  SmallRefit small(1);
  std::fill(small.training.response.begin(), small.training.response.end(), 0.0f);
  const RefitRow row = small.refitted(2);
  std::vector<float> sizes;
  for (size_t k = 0; k < SmallRefit::candidates; ++k) sizes.push_back(std::abs(small.all[k].value[0]));
  std::sort(sizes.rbegin(), sizes.rend());
  ASSERT_EQ(row.entries.size(), 2u);
  for (const SparseEntry& e : row.entries) {
    EXPECT_GE(std::abs(e.value), sizes[1] - 1e-6f);
    EXPECT_NEAR(e.value, small.all[e.column].value[0], 1e-6f);
  }
}

// On lights that it has not seen. Red if the correction has the wrong sign or goes to the wrong coefficients;
// choosing among twice as many candidates must help more than refitting alone.
TEST(LightRefit, HelpsOnOtherLights) {
  GatherSetup s(tiny::room(), 32, 24, 1024);
  FinalGatherSettings settings = short_rows();
  const TrainingLights training = lights_of(s, 1024, 3), others = lights_of(s, 32, 4);
  const SparseRows cut = s.final_gather(settings), fitted = s.final_gather(settings, {}, training);
  settings.refit_candidates = 2.0f;
  const SparseRows chosen = s.final_gather(settings, {}, training);
  settings.coefficients = 1024;
  const SparseRows whole = s.final_gather(settings);
  const double error_cut = mean_relative_error(cut, whole, others),
               error_fitted = mean_relative_error(fitted, whole, others),
               error_chosen = mean_relative_error(chosen, whole, others);
  EXPECT_LT(error_fitted, 0.97 * error_cut);
  EXPECT_LT(error_chosen, 0.97 * error_fitted);
  std::printf("errors %.4f %.4f %.4f\n", error_cut, error_fitted, error_chosen);
}

TEST(LightRefit, HasTheSameBitsForOneAndTwoThreads) {
  GatherSetup s(tiny::room(), 24, 20, 1024);
  std::vector<SparseRows> rows;
  FinalGatherSettings settings = short_rows();
  settings.refit_candidates = 1.5f;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    rows.push_back(s.final_gather(settings, {}, lights_of(s, 40, 3)));
  }
  ASSERT_EQ(rows[0].entries.size(), rows[1].entries.size());
  for (size_t e = 0; e < rows[0].entries.size(); ++e)
    ASSERT_EQ(std::pair(rows[0].entries[e].column, rows[0].entries[e].value),
              std::pair(rows[1].entries[e].column, rows[1].entries[e].value));
}

// A view that sees nothing has no place for lights, and a dark one no row to refit.
TEST(LightRefit, LeavesEmptyRowsAlone) {
  Scene scene = tiny::room();
  scene.camera.target = scene.camera.eye + glm::vec3(0, 0, 5);
  GatherSetup s(scene, 8, 8, 256);
  const TrainingLights lights = lights_of(s, 8, 3);
  EXPECT_EQ(lights.count, 0u);
  EXPECT_EQ(s.final_gather(short_rows(), {}, lights).entries.size(), 0u);
}

}  // namespace
}  // namespace relight::direct_to_indirect
