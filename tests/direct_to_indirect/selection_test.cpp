// Which coefficients are the heaviest, against sorting all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/sampling/random.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/selection.h"

namespace relight::direct_to_indirect {
namespace {

constexpr uint32_t columns = 4096;

// Values from a few steps, so that many weights are equal, and a third of them zero.
std::vector<LaneCoefficient> coefficients(uint64_t seed) {
  std::vector<LaneCoefficient> out;
  for (uint32_t j = 0; j < columns; ++j) {
    LaneCoefficient c{(j * 1021u) % columns, {}};  // each column once, in no order
    for (size_t i = 0; i < lanes; ++i) {
      const auto r = static_cast<int>(random_bits(seed, 7, j, i) % 9);
      c.value[i] = static_cast<float>(r / 3 * (r % 2 ? 1 : -1));
    }
    out.push_back(c);
  }
  return out;
}

std::vector<Candidate> sorted_all(const std::vector<LaneCoefficient>& all, size_t lane, float exponent,
                                  float factor) {
  std::vector<Candidate> out;
  for (const LaneCoefficient& c : all) {
    if (c.value[lane] == 0.0f) continue;
    const float area = std::pow(static_cast<float>(wavelet::support(c.index, columns)), exponent);
    out.push_back({std::abs(c.value[lane]) * area * factor, {c.index, c.value[lane]}});
  }
  std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) {
    return a.weight != b.weight ? a.weight > b.weight : a.entry.column < b.entry.column;
  });
  return out;
}

// Tried, each red: `>` for `>=` in the comparison with the least weight (ties lost); the largest weight kept
// taken for the least; one lane's factor for all; the level of a coefficient off by one; no second pass after
// a guess from the selection before that was too high.
TEST(Selection, FindsTheHeaviestOfEachLaneWithTiesGoingToTheSmallerColumn) {
  const std::vector<LaneCoefficient> all = coefficients(3);
  Lanes factor;
  for (size_t i = 0; i < lanes; ++i) factor[i] = 1.0f + static_cast<float>(i % 3);
  LaneSelection selection;
  for (const float exponent : {0.0f, 0.8f, 1.0f}) {
    for (const size_t limit : {size_t{1}, size_t{100}, size_t{1000}, size_t{columns}}) {
      select_largest(all, exponent, columns, factor, limit, selection);
      for (size_t lane = 0; lane < lanes; ++lane) {
        std::vector<Candidate> expected = sorted_all(all, lane, exponent, factor[lane]);
        double energy = 0.0;
        for (const Candidate& c : expected)
          energy += static_cast<double>(c.entry.value) * static_cast<double>(c.entry.value);
        EXPECT_EQ(selection.count[lane], static_cast<int64_t>(expected.size()));
        EXPECT_DOUBLE_EQ(selection.energy[lane], energy);  // sums of small integers
        expected.resize(std::min(expected.size(), limit));
        keep_largest(expected, limit);  // by column
        std::vector<Candidate> found = selection.largest[lane];
        keep_largest(found, limit);
        ASSERT_EQ(found.size(), expected.size()) << "exponent " << exponent << " limit " << limit;
        for (size_t k = 0; k < found.size(); ++k) {
          ASSERT_EQ(found[k].entry.column, expected[k].entry.column)
              << "exponent " << exponent << " limit " << limit << " lane " << lane;
          ASSERT_EQ(found[k].entry.value, expected[k].entry.value);
          ASSERT_EQ(found[k].weight, expected[k].weight);
        }
      }
    }
  }
}

// Red if the square is taken of the weight, or the smallest come first.
TEST(Selection, TakesAsManyOfTheHeaviestAsHoldTheEnergy) {
  std::vector<Candidate> candidates = {{1.0f, {4, 1.0f}}, {8.0f, {1, 2.0f}}, {3.0f, {2, 3.0f}}};
  EXPECT_EQ(count_for_energy(candidates, 4.0), 1u);
  EXPECT_EQ(count_for_energy(candidates, 4.1), 2u);
  EXPECT_EQ(count_for_energy(candidates, 13.5), 3u);
  EXPECT_EQ(count_for_energy(candidates, 20.0), 3u);
}

}  // namespace
}  // namespace relight::direct_to_indirect
