// Final-gather rows against a brute-force double-precision oracle of every (view sample, gather sample) pair.
#include "methods/direct_to_indirect/final_gather.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/run/thread_limit.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/column_scaling.h"
#include "tests/direct_to_indirect/gather_oracle.h"
#include "tests/direct_to_indirect/gather_setup.h"
#include "tests/direct_to_indirect/multi_bounce_setup.h"
#include "tests/support/tiny_scenes.h"

namespace relight::direct_to_indirect {
namespace {

// All links to single samples, nothing truncated: the tree-transformed row is the Haar transform of the dense
// row. Red if a cull drops a visible sample, a detail has the wrong sign or index, or a lane takes its
// neighbour's value.
TEST(FinalGather, UntruncatedRowsEqualTheBruteForceOracle) {
  GatherSetup s(tiny::room(), 20, 15, 1024, true);  // 15 rows: the last tile row is incomplete
  // Float F (some 10 roundings) and five levels of float Haar.
  EXPECT_LT(worst_difference(s, exact_settings(1024), 1e30), 2e-5);
}

// Red if the clamp is applied to the scaled coefficient instead of the element.
TEST(FinalGather, ClampsElementsAtTheGivenValue) {
  GatherSetup s(tiny::room(), 16, 12, 256, true);
  FinalGatherSettings settings = exact_settings(256);
  settings.form_factor_clamp = 0.01f;
  EXPECT_LT(worst_difference(s, settings, 0.01), 2e-5);
}

// Red if keep_largest keeps the smallest, or weights do not follow the support.
TEST(FinalGather, KeepsTheCoefficientsWithTheLargestAreaWeightedSize) {
  GatherSetup s(tiny::room(), 8, 8, 1024, true);
  const SparseRows all = s.final_gather(exact_settings(1024)), few = s.final_gather(exact_settings(20));
  for (size_t i = 0; i < s.buffer.indirect.size(); ++i) {
    const std::vector<double> full = dense_row(all, i), kept = dense_row(few, i);
    double smallest_kept = INFINITY, largest_left = 0.0;
    int count = 0, available = 0;
    for (uint32_t c = 0; c < 1024; ++c) {
      const double weight = std::abs(full[c]) * wavelet::support(c, 1024);
      available += full[c] != 0.0;
      if (kept[c] != 0.0) {
        EXPECT_EQ(kept[c], full[c]);
        smallest_kept = std::min(smallest_kept, weight);
        ++count;
      } else {
        largest_left = std::max(largest_left, weight);
      }
    }
    EXPECT_EQ(count, std::min(available, 20));  // walls seen from outside have none
    EXPECT_GE(smallest_kept, largest_left);
  }
}

// The fewest of the heaviest that hold 90 % of the sum of squares. Red if the fraction is taken of the sum of
// sizes or the last one needed is left out (both tried).
TEST(FinalGather, KeepsTheEnergyFractionThatIsAskedFor) {
  GatherSetup s(tiny::room(), 8, 8, 1024, true);
  FinalGatherSettings settings = exact_settings(1024);
  const SparseRows all = s.final_gather(settings);
  settings.energy_fraction = 0.9;
  const SparseRows few = s.final_gather(settings);
  for (size_t i = 0; i < s.buffer.indirect.size(); ++i) {
    double total = 0.0, held = 0.0, lightest = INFINITY, its_energy = 0.0;
    for (const double c : dense_row(all, i)) total += c * c;
    const std::vector<double> kept = dense_row(few, i);
    for (uint32_t c = 0; c < 1024; ++c) {
      held += kept[c] * kept[c];
      const double weight = std::abs(kept[c]) * wavelet::support(c, 1024);
      if (kept[c] != 0.0 && weight < lightest) lightest = weight, its_energy = kept[c] * kept[c];
    }
    EXPECT_GE(held, 0.9 * total * (1.0 - 1e-9));
    if (total > 0.0) {
      EXPECT_LT(held - its_energy, 0.9 * total);
    }
  }
}

// Row sums of links (a share of the hemisphere each) against those of all samples: the root mean square of
// their differences, and their mean, both over the exact sums.
struct RowSumError {
  double rms, bias;
};

RowSumError row_sum_error(GatherSetup& s, const FinalGatherSettings& linked) {
  const SparseRows exact = s.final_gather(exact_settings(linked.coefficients)), rows = s.final_gather(linked);
  double difference2 = 0.0, sum2 = 0.0, difference = 0.0, sum = 0.0;
  for (size_t i = 0; i < s.buffer.indirect.size(); ++i) {
    if (!s.buffer.indirect[i].valid) continue;
    const double a = dense_row(exact, i)[0], b = dense_row(rows, i)[0];
    difference2 += (a - b) * (a - b), sum2 += a * a;
    difference += b - a, sum += a;
  }
  return {std::sqrt(difference2 / sum2), difference / sum};
}

// Links to clusters approximate the row; its sum (the share of the hemisphere that is covered) must stay
// close. Red if a link forgets the cluster's size.
TEST(FinalGather, ClusterLinksKeepTheSumOfTheRow) {
  GatherSetup s(tiny::room(), 16, 12, 4096);
  FinalGatherSettings settings = exact_settings(4096);
  settings.link_threshold = 0.02f;
  EXPECT_LT(row_sum_error(s, settings).rms, 0.02);
}

// Members come from different parts of their cluster, so that the mean over several is better than over as
// many independent ones: four halve the error at least. Red if all take the same member (tried), or their
// mean is not divided by their number (tried).
TEST(FinalGather, SeveralMembersOfALinkHaveLessNoise) {
  GatherSetup s(tiny::room(), 16, 12, 4096);
  FinalGatherSettings settings = exact_settings(4096);
  settings.link_threshold = 0.05f;
  std::vector<double> error;
  for (const int members : {1, 2, 4}) {
    settings.link_members = members;
    error.push_back(row_sum_error(s, settings).rms);
  }
  EXPECT_LT(error[1], error[0]);
  EXPECT_LT(error[2], 0.5 * error[0]);
}

// Nothing hides anything in an empty box, so that a link by its cluster's mean element is wrong only by the
// curvature of the element over the cluster, second order in its size; a random member is wrong by first
// order, and by its area. Red if the mean is not weighted by area, or a cluster has another's (both tried).
TEST(FinalGather, MeanElementsAreFreeOfTheNoiseOfRandomMembers) {
  Scene box = closed_box(glm::vec3(0.5f));
  box.camera.eye = {0.2f, 0.3f, 0.4f}, box.camera.target = {0.9f, 0.6f, 0.5f};
  GatherSetup s(std::move(box), 16, 12, 4096);
  FinalGatherSettings settings = exact_settings(4096);
  settings.link_threshold = 0.02f;
  const RowSumError one = row_sum_error(s, settings);
  settings.mean_elements = true;
  const RowSumError mean = row_sum_error(s, settings);
  EXPECT_LT(mean.rms, one.rms / 2.0);
}

// Of a small ball every view sample sees half of one side: the elements of the other samples are zero, while
// the mean of their normals would subtract them. Red (-13 and -18 %) if clusters that partly face away, or
// all, are taken by their mean (both tried).
TEST(FinalGather, MeanElementsAreNotTakenOfClustersThatPartlyFaceAway) {
  Scene balls = tiny::empty_scene(glm::vec3(0.5f));
  tiny::add_quad(balls, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  for (float x = -0.9f; x < 1.0f; x += 0.6f)
    for (float z = -0.9f; z < 1.0f; z += 0.6f) tiny::add_sphere(balls, {x, 1.0f, z}, 0.1f, 12);
  finish_scene(balls);
  balls.camera.eye = {0.0f, 0.8f, 1.5f}, balls.camera.target = {0.0f, -0.2f, 0.0f};
  GatherSetup s(std::move(balls), 16, 12, 4096, true);
  FinalGatherSettings settings = exact_settings(4096);
  settings.link_threshold = 0.02f;
  settings.mean_elements = true;
  EXPECT_NEAR(row_sum_error(s, settings).bias, 0.0, 0.01);
}

// Red if the random members depend on the thread, or a worker's scratch leaks from tile to tile.
TEST(FinalGather, HasTheSameBitsForOneAndTwoThreads) {
  GatherSetup s(tiny::room(), 24, 20, 1024);
  FinalGatherSettings settings;
  settings.coefficients = 50;
  std::vector<SparseRows> rows;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    rows.push_back(s.final_gather(settings));
  }
  ASSERT_EQ(rows[0].entries.size(), rows[1].entries.size());
  for (size_t e = 0; e < rows[0].entries.size(); ++e) {
    EXPECT_EQ(rows[0].entries[e].column, rows[1].entries[e].column);
    EXPECT_EQ(rows[0].entries[e].value, rows[1].entries[e].value);
  }
}

// A change of variables: without truncation and with single-sample links, dividing columns and multiplying
// the light by the same factors changes nothing. Red if an element is divided by the square
// root of its factor. Links to single samples only: which member's factor a larger link takes is not tested.
TEST(FinalGather, ColumnScalingChangesNoUntruncatedProduct) {
  GatherSetup s(tiny::room(), 12, 12, 1024);
  const FinalGatherSettings settings = exact_settings(1024);
  const std::vector<float> scale = mean_row_scaling(s.tracer, s.buffer, s.cloud, s.hierarchy, settings);
  const SparseRows plain = s.final_gather(settings), scaled = s.final_gather(settings, scale);
  EXPECT_GT(*std::max_element(scale.begin(), scale.end()),
            1.5f * *std::min_element(scale.begin(), scale.end()));
  for (size_t i = 0; i < s.buffer.indirect.size(); ++i) {
    const std::vector<double> a = wavelet::inverse(dense_row(plain, i)),
                              b = wavelet::inverse(dense_row(scaled, i));
    const double largest = *std::max_element(a.begin(), a.end());
    for (size_t j = 0; j < a.size(); ++j)
      ASSERT_NEAR(a[j], b[j] * static_cast<double>(scale[j]), 1e-4 * largest);
  }
}

// Red if the threshold is taken from the wrong end of the weights, or rows without albedo get coefficients.
TEST(FinalGather, SharedBudgetKeepsTheSameNumberInAllAndMoreWhereRowsAreBrighter) {
  GatherSetup s(tiny::room(), 96, 72, 1024);
  FinalGatherSettings settings;
  settings.coefficients = 30;
  const size_t fixed = s.final_gather(settings).entries.size();
  settings.shared_budget = true;
  for (size_t i = 0; i < s.buffer.indirect.size() / 2; ++i) s.buffer.indirect[i].diffuse = glm::vec3(0.0f);
  const SparseRows shared = s.final_gather(settings);
  const auto total = static_cast<double>(fixed);
  EXPECT_NEAR(static_cast<double>(shared.entries.size()), total, 0.15 * total);
  EXPECT_EQ(shared.row_start[s.buffer.indirect.size() / 2], 0u);
}

TEST(FinalGather, HasEmptyRowsWhereTheCameraSeesNothing) {
  Scene scene = tiny::room();
  scene.camera.target = scene.camera.eye + glm::vec3(0, 0, 5);
  GatherSetup s(std::move(scene), 8, 8, 256);
  EXPECT_EQ(s.final_gather({}).entries.size(), 0u);
}

}  // namespace
}  // namespace relight::direct_to_indirect
