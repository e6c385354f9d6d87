#include "methods/direct_to_indirect/final_gather.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "methods/direct_to_indirect/light_refit.h"
#include "methods/direct_to_indirect/selection.h"
#include "methods/direct_to_indirect/tile_gather.h"
#include "methods/direct_to_indirect/view_tiles.h"

namespace relight::direct_to_indirect {
namespace {

struct Totals {
  GatherCounts gather;
  int64_t before = 0;  // coefficients before truncation
  double energy_before = 0,
         energy_kept = 0;  // reported only: their sums may differ in the last bits between runs
};

// Scratch of one worker thread.
struct Worker {
  TileGather gather;
  std::optional<LightRefit> refit;
  std::array<RefitRow, lanes> rows;
  LaneSelection selection;
  Totals totals;
};

class Builder {
 public:
  // threshold: of shared_budget_threshold; used with settings.shared_budget only.
  Builder(const DeepFrameBuffer& buffer, const FinalGatherSettings& settings, uint32_t columns,
          float threshold)
      : buffer_(buffer),
        settings_(settings),
        columns_(columns),
        threshold_(threshold),
        view_tiles_(buffer),
        tiles_(static_cast<size_t>(view_tiles_.count())) {}

  // Numbers of the tiles that are marked, or of all if none is.
  std::vector<int> chosen(std::span<const uint8_t> marked) const {
    std::vector<int> out;
    for (int t = 0; t < view_tiles_.count(); ++t)
      if (marked.empty() || marked[static_cast<size_t>(t)]) out.push_back(t);
    return out;
  }

  void tile(Worker& worker, int t) {
    const std::array<const SurfaceSample*, lanes> samples = view_tiles_.samples(t);
    worker.gather.gather(samples, static_cast<uint64_t>(t));
    select_largest(worker.gather.coefficients(), settings_.support_exponent, columns_, row_factors(samples),
                   candidate_limit(worker), worker.selection);
    for (size_t i = 0; i < lanes; ++i) {
      worker.rows[i] = {};
      if (samples[i] && samples[i]->valid) worker.rows[i] = select(worker, i);
    }
    if (worker.refit) worker.refit->refit(worker.gather.coefficients(), worker.rows);
    TileRows& rows = tiles_[static_cast<size_t>(t)];
    for (size_t i = 0; i < lanes; ++i) {
      const std::vector<SparseEntry>& row = worker.rows[i].entries;
      for (const SparseEntry& e : row)
        worker.totals.energy_kept += static_cast<double>(e.value) * static_cast<double>(e.value);
      rows.entries.insert(rows.entries.end(), row.begin(), row.end());
      rows.end[i] = static_cast<uint32_t>(rows.entries.size());
    }
  }

  SparseRows finish() {
    SparseRows rows;
    rows.columns = columns_;
    rows.row_start.push_back(0);
    size_t total = 0;
    for (const TileRows& t : tiles_) total += t.entries.size();
    rows.entries.reserve(total);
    for (int y = 0; y < buffer_.view.height; ++y)
      for (int x = 0; x < buffer_.view.width; ++x) {
        TileRows& t = tiles_[view_tiles_.tile_of(x, y)];
        const size_t lane = ViewTiles::lane_of(x, y);
        const std::ptrdiff_t first = lane == 0 ? 0 : t.end[lane - 1];
        rows.entries.insert(rows.entries.end(), t.entries.begin() + first, t.entries.begin() + t.end[lane]);
        rows.row_start.push_back(rows.entries.size());
        // Rows that keep every coefficient are large: they are let go as soon as they have been copied.
        if (lane + 1 == lanes) t.entries = {};
      }
    return rows;
  }

 private:
  // The rows of one tile's lanes, one after the other; lane i ends at end[i].
  struct TileRows {
    std::vector<SparseEntry> entries;
    std::array<uint32_t, lanes> end{};
  };

  Lanes row_factors(const std::array<const SurfaceSample*, lanes>& samples) const {
    Lanes factors;
    for (size_t i = 0; i < lanes; ++i)
      factors[i] = settings_.shared_budget && samples[i] ? row_factor(*samples[i]) : 1.0f;
    return factors;
  }

  static float surplus(const Worker& worker, const FinalGatherSettings& settings) {
    return worker.refit ? settings.refit_candidates : 1.0f;
  }
  // Of a row's coefficients no more are looked at.
  size_t candidate_limit(const Worker& worker) const {
    return static_cast<size_t>(
        std::ceil(std::max(surplus(worker, settings_), 1.0f) * static_cast<float>(settings_.row_limit())));
  }

  // What the row keeps, or with a refit: what it may keep, and how many of them.
  RefitRow select(Worker& worker, size_t lane) const {
    std::vector<Candidate>& candidates = worker.selection.largest[lane];
    worker.totals.before += worker.selection.count[lane];
    worker.totals.energy_before += worker.selection.energy[lane];

    RefitRow row;
    row.target = candidates.size();
    if (settings_.shared_budget)
      row.target =
          static_cast<size_t>(std::count_if(candidates.begin(), candidates.end(),
                                            [this](const Candidate& c) { return c.weight > threshold_; }));
    row.target = std::min(row.target, settings_.row_limit());
    if (settings_.energy_fraction < 1.0)
      row.target = std::min(row.target, count_for_energy(candidates, settings_.energy_fraction *
                                                                         worker.selection.energy[lane]));
    keep_largest(candidates,
                 static_cast<size_t>(surplus(worker, settings_) * static_cast<float>(row.target)));
    for (const Candidate& c : candidates) row.entries.push_back(c.entry);
    return row;
  }

  const DeepFrameBuffer& buffer_;
  const FinalGatherSettings& settings_;
  uint32_t columns_;
  float threshold_;
  ViewTiles view_tiles_;
  std::vector<TileRows> tiles_;
};

}  // namespace

SparseRows compute_final_gather(const FinalGatherInput& in, const FinalGatherSettings& settings,
                                Progress& progress, StageLog& log) {
  const float threshold =
      settings.shared_budget
          ? shared_budget_threshold(in.tracer, in.buffer, in.cloud, in.hierarchy, settings, in.column_scale)
          : 0.0f;
  Builder builder(in.buffer, settings, static_cast<uint32_t>(in.cloud.samples.size()), threshold);
  tbb::enumerable_thread_specific<Worker> workers([&] {
    Worker worker{TileGather(in.tracer, in.cloud, in.hierarchy, settings, in.column_scale, in.near_field),
                  {},
                  {},
                  {},
                  {}};
    if (in.training.count > 0) worker.refit.emplace(in.training, settings.refit_ridge);
    return worker;
  });
  const std::vector<int> chosen = builder.chosen(in.tiles);
  progress.start("final gather", static_cast<int64_t>(chosen.size()));
  tbb::parallel_for(size_t{0}, chosen.size(), [&](size_t i) {
    builder.tile(workers.local(), chosen[i]);
    progress.advance();
  });
  progress.finish();

  Totals sum;
  for (const Worker& w : workers) {
    sum.gather.rays += w.gather.counts().rays;
    sum.gather.links += w.gather.counts().links;
    sum.gather.near_elements += w.gather.counts().near_elements;
    sum.gather.near_rays += w.gather.counts().near_rays;
    sum.before += w.totals.before;
    sum.energy_before += w.totals.energy_before;
    sum.energy_kept += w.totals.energy_kept;
  }
  SparseRows rows = builder.finish();
  log.count("visibility_rays", sum.gather.rays);
  log.count("links", sum.gather.links);
  if (in.near_field) {
    log.count("near_elements", sum.gather.near_elements);
    log.count("near_rays", sum.gather.near_rays);
  }
  log.count("coefficients_before_truncation", sum.before);
  log.count("non_zeros", static_cast<int64_t>(rows.entries.size()));
  if (sum.energy_before > 0.0 && in.training.count == 0)  // refitted values carry what was dropped
    log.count("row_energy_kept_ppm", std::llround(1e6 * sum.energy_kept / sum.energy_before));
  return rows;
}

}  // namespace relight::direct_to_indirect
