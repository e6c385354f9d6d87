#include "methods/direct_to_indirect/selection.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <ranges>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "common/image/luminance.h"
#include "methods/direct_to_indirect/view_tiles.h"

namespace relight::direct_to_indirect {

namespace {

bool heavier(const Candidate& a, const Candidate& b) {
  return a.weight != b.weight ? a.weight > b.weight : a.entry.column < b.entry.column;
}

// Leaves the `limit` heaviest, unordered.
void cut(std::vector<Candidate>& candidates, size_t limit) {
  if (candidates.size() <= limit) return;
  std::nth_element(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(limit),
                   candidates.end(), heavier);
  candidates.resize(limit);
}

float lightest(const std::vector<Candidate>& candidates) {
  return std::ranges::min_element(candidates, {}, &Candidate::weight)->weight;
}

// support^exponent of the coefficients by level of the tree; that of the root is every sample.
std::array<float, 17> weights_of_levels(uint32_t columns, float exponent) {
  std::array<float, 17> weights{};
  uint64_t support = columns;
  for (float& w : weights) {
    w = std::pow(static_cast<float>(support), exponent);
    support = std::max<uint64_t>(support / 4, 1);
  }
  return weights;
}

// Of details: those of the root are 1 to 3, of the level below 4 to 15, ...
size_t level_of(uint32_t index) {
  return index == 0 ? 0 : static_cast<size_t>(std::bit_width(index) - 1) / 2;
}

}  // namespace

size_t count_for_energy(std::vector<Candidate>& candidates, double energy) {
  std::sort(candidates.begin(), candidates.end(), heavier);
  double held = 0.0;
  size_t count = 0;
  while (count < candidates.size() && held < energy) {
    const auto value = static_cast<double>(candidates[count++].entry.value);
    held += value * value;
  }
  return count;
}

namespace {

// One pass over the coefficients. `least`, by lane: nothing lighter is looked at. Most coefficients are
// lighter than `limit` others met before: they only cost a comparison, 16 lanes at a time.
void collect(const std::vector<LaneCoefficient>& coefficients, const std::array<float, 17>& level_weight,
             const Lanes& row_factor, size_t limit, Lanes least, LaneSelection& out) {
  out.count.fill(0), out.energy.fill(0.0);
  for (std::vector<Candidate>& c : out.largest) c.clear();
  const size_t room = 2 * limit + 64;
  // Backwards: a depth-first walk leaves the coarse levels last, and they are the heaviest by area.
  for (const LaneCoefficient& c : std::views::reverse(coefficients)) {
    const float area = level_weight[level_of(c.index)];
    Lanes weight;
    std::array<uint32_t, lanes> heavy;
    uint32_t any = 0;
    for (size_t i = 0; i < lanes; ++i) {
      const float v = c.value[i];
      weight[i] = std::abs(v) * area * row_factor[i];
      const uint32_t not_zero = v != 0.0f ? 1 : 0;
      heavy[i] = weight[i] >= least[i] ? not_zero : 0;
      any |= heavy[i];
      out.count[i] += not_zero;
      out.energy[i] += static_cast<double>(v) * static_cast<double>(v);
    }
    if (!any) continue;
    for (size_t i = 0; i < lanes; ++i) {
      if (!heavy[i]) continue;
      std::vector<Candidate>& largest = out.largest[i];
      largest.push_back({weight[i], {c.index, c.value[i]}});
      if (largest.size() < room) continue;
      cut(largest, limit);
      least[i] = lightest(largest);
    }
  }
  for (std::vector<Candidate>& largest : out.largest) cut(largest, limit);
}

// No lane has fewer than it should because of the weight that the pass began with.
bool complete(const LaneSelection& selection, size_t limit) {
  for (size_t i = 0; i < lanes; ++i)
    if (selection.largest[i].size() < std::min(limit, static_cast<size_t>(selection.count[i]))) return false;
  return true;
}

}  // namespace

// Neighbouring tiles have similar rows. A pass that begins with half of the weight at which the last tile was
// cut meets little that it drops again; where it finds too few, it begins anew from zero.
void select_largest(const std::vector<LaneCoefficient>& coefficients, float support_exponent,
                    uint32_t columns, const Lanes& row_factor, size_t limit, LaneSelection& out) {
  const std::array<float, 17> level_weight = weights_of_levels(columns, support_exponent);
  collect(coefficients, level_weight, row_factor, limit, out.guess, out);
  if (!complete(out, limit)) collect(coefficients, level_weight, row_factor, limit, Lanes{}, out);
  for (size_t i = 0; i < lanes; ++i)
    out.guess[i] = limit > 0 && out.largest[i].size() == limit ? 0.5f * lightest(out.largest[i]) : 0.0f;
}

void keep_largest(std::vector<Candidate>& candidates, size_t limit) {
  cut(candidates, limit);
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.entry.column < b.entry.column; });
}

float row_factor(const SurfaceSample& s, MatrixPart part) {
  return luminance(part == MatrixPart::diffuse ? s.diffuse : s.glossy);
}

float shared_budget_threshold(const DeepFrameBuffer& buffer, const FinalGatherSettings& settings,
                              MatrixPart part, uint32_t columns,
                              const std::function<TileGather()>& make_gather) {
  const ViewTiles tiles(buffer);
  const std::vector<int> chosen = tiles.subset(settings.seed);
  const size_t limit = settings.row_limit(part);
  tbb::enumerable_thread_specific<TileGather> gathers(make_gather);
  std::vector<std::vector<float>> weights(chosen.size());
  std::vector<size_t> rows(chosen.size(), 0);
  tbb::parallel_for(size_t{0}, chosen.size(), [&](size_t i) {
    const auto samples = tiles.samples(chosen[i]);
    TileGather& gather = gathers.local();
    gather.gather(samples, static_cast<uint64_t>(chosen[i]));
    Lanes factor{};
    for (size_t lane = 0; lane < lanes; ++lane) {
      if (!samples[lane] || !samples[lane]->valid) continue;
      if (part == MatrixPart::glossy && !is_glossy(*samples[lane])) continue;
      ++rows[i];
      factor[lane] = row_factor(*samples[lane], part);
    }
    LaneSelection selection;
    select_largest(part == MatrixPart::diffuse ? gather.coefficients() : gather.glossy_coefficients(),
                   settings.support_exponent, columns, factor, limit, selection);
    for (const std::vector<Candidate>& largest : selection.largest)
      for (const Candidate& c : largest) weights[i].push_back(c.weight);
  });
  std::vector<float> all;
  size_t valid_rows = 0;
  for (size_t i = 0; i < chosen.size(); ++i) {
    all.insert(all.end(), weights[i].begin(), weights[i].end());
    valid_rows += rows[i];
  }
  const size_t wanted = valid_rows * static_cast<size_t>(settings.budget(part));
  if (wanted >= all.size()) return 0.0f;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(wanted), all.end(),
                   std::greater<float>());
  return all[wanted];
}

}  // namespace relight::direct_to_indirect
