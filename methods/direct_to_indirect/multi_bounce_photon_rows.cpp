#include "methods/direct_to_indirect/multi_bounce_photon_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "common/wavelet/haar.h"
#include "common/wavelet/sparse_haar.h"
#include "methods/direct_to_indirect/multi_bounce_nearest.h"

namespace relight::direct_to_indirect {
namespace {

constexpr float least_normal_cosine = 0.5f;  // 60 degrees
constexpr size_t rows_a_task = 64;           // neighbours in tree order search the same photons

// A coefficient by its place in Worker::coefficients.
struct Ranked {
  float weight;
  uint32_t at;
};

// Scratch and counts of one worker thread.
struct Worker {
  std::vector<Neighbour> nearest;
  std::vector<wavelet::SparseValue> values, coefficients;
  std::vector<Ranked> ranked;
  int64_t before = 0, empty = 0;
};

class RowBuilder {
 public:
  RowBuilder(const MultiBounceInput& input, const PhotonMap& map, const MultiBounceSettings& settings)
      : in_(input), photons_(map.photons), settings_(settings), tree_(map.photons) {}

  std::vector<SparseEntryRgb> row(Worker& worker, uint32_t sample) const {
    estimate(worker, sample);
    wavelet::forward_sparse(worker.values, columns(), worker.coefficients);
    worker.before += static_cast<int64_t>(worker.coefficients.size());
    return select(worker);
  }

 private:
  uint32_t columns() const { return static_cast<uint32_t>(in_.cloud.samples.size()); }

  // Row `sample` of M', not yet in wavelet space: worker.values, ascending.
  void estimate(Worker& worker, uint32_t sample) const {
    worker.values.clear();
    const SurfaceSample& at = in_.cloud.samples[sample];
    if (at.diffuse == glm::vec3(0.0f)) return;
    tree_.find(at.position, static_cast<size_t>(settings_.neighbours), worker.nearest);
    const auto farthest =
        std::max_element(worker.nearest.begin(), worker.nearest.end(),
                         [](const Neighbour& a, const Neighbour& b) { return a.distance2 < b.distance2; });
    if (farthest == worker.nearest.end() || !(farthest->distance2 > 0.0f)) {
      ++worker.empty;
      return;
    }
    const float disc = std::numbers::pi_v<float> * farthest->distance2;
    worker.nearest.erase(farthest);
    std::sort(worker.nearest.begin(), worker.nearest.end(),  // photons are numbered by source
              [](const Neighbour& a, const Neighbour& b) { return a.photon < b.photon; });
    for (const Neighbour& n : worker.nearest) {
      const Photon& photon = photons_[n.photon];
      if (glm::dot(photon.normal, at.geometric_normal) < least_normal_cosine) continue;
      if (worker.values.empty() || worker.values.back().index != photon.source)
        worker.values.push_back({photon.source, glm::vec3(0.0f)});
      worker.values.back().value += photon.area;
    }
    for (wavelet::SparseValue& v : worker.values)
      v.value *= at.diffuse * (scale_ratio(sample, v.index) / disc);
  }

  float scale_ratio(uint32_t row, uint32_t column) const {
    return in_.column_scale.empty() ? 1.0f : in_.column_scale[row] / in_.column_scale[column];
  }

  // The rule of keep_largest() in selection.h, without a sort of all coefficients, of which a row has
  // thousands.
  std::vector<SparseEntryRgb> select(Worker& worker) const {
    const std::vector<wavelet::SparseValue>& all = worker.coefficients;
    worker.ranked.clear();
    for (uint32_t k = 0; k < all.size(); ++k) worker.ranked.push_back({weight(all[k]), k});
    const size_t limit = std::min(all.size(), static_cast<size_t>(settings_.coefficients));
    std::nth_element(worker.ranked.begin(), worker.ranked.begin() + static_cast<std::ptrdiff_t>(limit),
                     worker.ranked.end(), [&all](const Ranked& a, const Ranked& b) {
                       return a.weight != b.weight ? a.weight > b.weight : all[a.at].index < all[b.at].index;
                     });
    std::vector<SparseEntryRgb> kept;
    for (size_t k = 0; k < limit; ++k)
      kept.push_back({all[worker.ranked[k].at].index, all[worker.ranked[k].at].value});
    std::sort(kept.begin(), kept.end(),
              [](const SparseEntryRgb& a, const SparseEntryRgb& b) { return a.column < b.column; });
    return kept;
  }

  float weight(const wavelet::SparseValue& c) const {
    const auto support = static_cast<float>(wavelet::support(c.index, columns()));
    const float exponent = settings_.gather.support_exponent;
    return glm::length(c.value) * (exponent == 1.0f ? support : std::pow(support, exponent));
  }

  const MultiBounceInput& in_;
  const std::vector<Photon>& photons_;
  const MultiBounceSettings& settings_;
  NearestPhotons tree_;
};

}  // namespace

SparseRowsRgb photon_rows(const MultiBounceInput& input, const PhotonMap& map,
                          const MultiBounceSettings& settings, Progress& progress, StageLog& log) {
  const size_t samples = input.cloud.samples.size();
  const RowBuilder builder(input, map, settings);
  std::vector<std::vector<SparseEntryRgb>> rows(samples);
  tbb::enumerable_thread_specific<Worker> workers;
  const size_t tasks = (samples + rows_a_task - 1) / rows_a_task;
  progress.start("multi-bounce rows", static_cast<int>(tasks));
  tbb::parallel_for(size_t{0}, tasks, [&](size_t t) {
    Worker& worker = workers.local();
    for (size_t i = t * rows_a_task; i < std::min(samples, (t + 1) * rows_a_task); ++i)
      rows[i] = builder.row(worker, static_cast<uint32_t>(i));
    progress.advance();
  });
  progress.finish();

  SparseRowsRgb out;
  out.columns = static_cast<uint32_t>(samples);
  out.row_start.push_back(0);
  for (const std::vector<SparseEntryRgb>& row : rows) {
    out.entries.insert(out.entries.end(), row.begin(), row.end());
    out.row_start.push_back(out.entries.size());
  }
  int64_t before = 0, empty = 0;
  for (const Worker& w : workers) before += w.before, empty += w.empty;
  log.count("bounce_coefficients_before_truncation", before);
  log.count("photon_discs_empty", empty);
  return out;
}

}  // namespace relight::direct_to_indirect
