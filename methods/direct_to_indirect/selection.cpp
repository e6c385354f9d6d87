#include "methods/direct_to_indirect/selection.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "common/image/luminance.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/view_tiles.h"

namespace relight::direct_to_indirect {

namespace {

bool heavier(const Candidate& a, const Candidate& b) {
  return a.weight != b.weight ? a.weight > b.weight : a.entry.column < b.entry.column;
}

double energy(const Candidate& c) {
  return static_cast<double>(c.entry.value) * static_cast<double>(c.entry.value);
}

}  // namespace

size_t count_for_energy(std::vector<Candidate>& candidates, double fraction) {
  std::sort(candidates.begin(), candidates.end(), heavier);
  double total = 0.0, held = 0.0;
  for (const Candidate& c : candidates) total += energy(c);
  size_t count = 0;
  while (count < candidates.size() && held < fraction * total) held += energy(candidates[count++]);
  return count;
}

void collect_candidates(const std::vector<LaneCoefficient>& coefficients, size_t lane, float support_exponent,
                        uint32_t columns, float row_factor, std::vector<Candidate>& out) {
  out.clear();
  for (const LaneCoefficient& c : coefficients) {
    const float value = c.value[lane];
    if (value == 0.0f) continue;
    const auto support = static_cast<float>(wavelet::support(c.index, columns));
    const float area = support_exponent == 1.0f ? support : std::pow(support, support_exponent);
    out.push_back({std::abs(value) * area * row_factor, {c.index, value}});
  }
}

void keep_largest(std::vector<Candidate>& candidates, size_t limit) {
  if (candidates.size() > limit) {
    std::nth_element(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(limit),
                     candidates.end(), heavier);
    candidates.resize(limit);
  }
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
    std::vector<Candidate> candidates;
    for (size_t lane = 0; lane < lanes; ++lane) {
      if (!samples[lane] || !samples[lane]->valid) continue;
      if (part == MatrixPart::glossy && !is_glossy(*samples[lane])) continue;
      ++rows[i];
      collect_candidates(part == MatrixPart::diffuse ? gather.coefficients() : gather.glossy_coefficients(),
                         lane, settings.support_exponent, columns, row_factor(*samples[lane], part),
                         candidates);
      keep_largest(candidates, limit);
      for (const Candidate& c : candidates) weights[i].push_back(c.weight);
    }
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
