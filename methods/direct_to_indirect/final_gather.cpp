#include "methods/direct_to_indirect/final_gather.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "methods/direct_to_indirect/row_builder.h"
#include "methods/direct_to_indirect/tile_gather.h"

namespace relight::direct_to_indirect {
namespace {

struct Worker {
  TileGather gather;
  RowScratch diffuse, glossy;
};

void log_walk(const FinalGatherInput& in, const GatherCounts& counts, StageLog& log) {
  log.count("visibility_rays", counts.rays);
  log.count("links", counts.links);
  if (!in.near_field) return;
  log.count("near_elements", counts.near_elements);
  log.count("near_rays", counts.near_rays);
}

// prefix: of the counters' names.
void log_rows(const std::string& prefix, const RowTotals& totals, const SparseRows& rows, bool refitted,
              StageLog& log) {
  log.count(prefix + "coefficients_before_truncation", totals.before);
  log.count(prefix + "non_zeros", static_cast<int64_t>(rows.entries.size()));
  if (totals.energy_before > 0.0 && !refitted)  // refitted values carry what was dropped
    log.count(prefix + "row_energy_kept_ppm", std::llround(1e6 * totals.energy_kept / totals.energy_before));
}

}  // namespace

FinalGather compute_final_gather(const FinalGatherInput& in, const FinalGatherSettings& settings,
                                 Progress& progress, StageLog& log) {
  const auto columns = static_cast<uint32_t>(in.cloud.samples.size());
  FinalGather out;
  if (in.glossy) {
    out.glossy_pixels = glossy_pixels(in.buffer);
    log.count("glossy_pixels", static_cast<int64_t>(out.glossy_pixels.size()));
  }
  const GlossyGather* glossy = out.glossy_pixels.empty() ? nullptr : in.glossy;
  const auto make_gather = [&] {
    return TileGather(in.tracer, in.cloud, in.hierarchy, settings, in.column_scale, in.near_field, glossy);
  };
  const auto make_rows = [&](MatrixPart part) {
    const float threshold = settings.shared_budget
                                ? shared_budget_threshold(in.buffer, settings, part, columns, make_gather)
                                : 0.0f;
    return RowBuilder(in.buffer, settings, part, columns, threshold,
                      part == MatrixPart::diffuse ? in.basis : nullptr);
  };
  RowBuilder diffuse_rows = make_rows(MatrixPart::diffuse);
  std::optional<RowBuilder> glossy_rows;
  if (glossy) glossy_rows.emplace(make_rows(MatrixPart::glossy));

  tbb::enumerable_thread_specific<Worker> workers([&] {
    Worker worker{make_gather(), {}, {}};
    if (in.training.count > 0) worker.diffuse.refit.emplace(in.training, settings.refit_ridge);
    if (in.training.count > 0 && glossy) worker.glossy.refit.emplace(in.training, settings.refit_ridge);
    return worker;
  });
  const ViewTiles tiles(in.buffer);
  std::vector<int> chosen;
  for (int t = 0; t < tiles.count(); ++t)
    if (in.tiles.empty() || in.tiles[static_cast<size_t>(t)]) chosen.push_back(t);
  progress.start("final gather", static_cast<int64_t>(chosen.size()));
  tbb::parallel_for(size_t{0}, chosen.size(), [&](size_t i) {
    const int t = chosen[i];
    Worker& worker = workers.local();
    worker.gather.gather(tiles.samples(t), static_cast<uint64_t>(t));
    diffuse_rows.add(worker.diffuse, worker.gather.coefficients(), t);
    if (glossy_rows && !worker.gather.glossy_coefficients().empty())
      glossy_rows->add(worker.glossy, worker.gather.glossy_coefficients(), t);
    progress.advance();
  });
  progress.finish();

  GatherCounts counts;
  RowTotals diffuse_totals, glossy_totals;
  for (const Worker& w : workers) {
    counts += w.gather.counts();
    diffuse_totals += w.diffuse.totals;
    glossy_totals += w.glossy.totals;
  }
  out.diffuse = diffuse_rows.finish();
  log_walk(in, counts, log);
  log_rows("", diffuse_totals, out.diffuse, in.training.count > 0, log);
  if (!glossy) return out;
  out.glossy = glossy_rows->finish();
  if (glossy->rays) log.count("glossy_rays", counts.glossy_rays);
  log_rows("glossy_", glossy_totals, out.glossy, in.training.count > 0, log);
  return out;
}

}  // namespace relight::direct_to_indirect
