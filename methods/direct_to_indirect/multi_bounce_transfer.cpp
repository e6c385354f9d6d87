#include "methods/direct_to_indirect/multi_bounce_transfer.h"

#include <algorithm>
#include <array>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "common/image/luminance.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/selection.h"
#include "methods/direct_to_indirect/tile_gather.h"

namespace relight::direct_to_indirect {
namespace {

// Scratch and counts of one worker thread.
struct Worker {
  TileGather gather;
  LaneSelection selection;
  int64_t before = 0;
};

using Rows = std::array<std::vector<SparseEntry>, lanes>;

std::array<const SurfaceSample*, lanes> tile_samples(const GatherCloud& cloud, size_t tile) {
  std::array<const SurfaceSample*, lanes> out{};
  for (size_t i = 0; i < lanes && tile * lanes + i < cloud.samples.size(); ++i)
    out[i] = &cloud.samples[tile * lanes + i];
  return out;
}

Rows tile_rows(Worker& worker, const MultiBounceInput& in, const MultiBounceSettings& settings, size_t tile) {
  const auto samples = tile_samples(in.cloud, tile);
  worker.gather.gather(samples, tile);
  Lanes no_factor;
  no_factor.fill(1.0f);
  const auto limit = static_cast<size_t>(settings.coefficients);
  select_largest(worker.gather.coefficients(), settings.gather.support_exponent,
                 static_cast<uint32_t>(in.cloud.samples.size()), no_factor, limit, worker.selection);
  Rows rows;
  for (size_t i = 0; i < lanes; ++i) {
    if (!samples[i]) continue;
    worker.before += worker.selection.count[i];
    keep_largest(worker.selection.largest[i], limit);
    for (const Candidate& c : worker.selection.largest[i]) rows[i].push_back(c.entry);
  }
  return rows;
}

}  // namespace

SparseRows transfer_rows(const MultiBounceInput& in, const MultiBounceSettings& settings, Progress& progress,
                         StageLog& log) {
  const size_t samples = in.cloud.samples.size(), tiles = (samples + lanes - 1) / lanes;
  std::vector<Rows> rows(tiles);
  tbb::enumerable_thread_specific<Worker> workers([&] {
    return Worker{TileGather(in.tracer, in.cloud, in.hierarchy, settings.gather, in.column_scale), {}};
  });
  progress.start("multi-bounce rows", static_cast<int>(tiles));
  tbb::parallel_for(size_t{0}, tiles, [&](size_t t) {
    rows[t] = tile_rows(workers.local(), in, settings, t);
    progress.advance();
  });
  progress.finish();

  SparseRows out;
  out.columns = static_cast<uint32_t>(samples);
  out.row_start.push_back(0);
  for (size_t i = 0; i < samples; ++i) {
    const std::vector<SparseEntry>& row = rows[i / lanes][i % lanes];
    out.entries.insert(out.entries.end(), row.begin(), row.end());
    out.row_start.push_back(out.entries.size());
  }
  GatherCounts counts;
  int64_t before = 0;
  for (const Worker& w : workers) {
    counts.rays += w.gather.counts().rays, counts.links += w.gather.counts().links;
    before += w.before;
  }
  log.count("bounce_visibility_rays", counts.rays);
  log.count("bounce_links", counts.links);
  log.count("bounce_coefficients_before_truncation", before);
  return out;
}

std::vector<double> transfer_power(const MultiBounceInput& in, const SparseRows& rows, int bounces) {
  const size_t n = in.cloud.samples.size();
  const auto scale = [&](size_t i) {
    return in.column_scale.empty() ? 1.0 : static_cast<double>(in.column_scale[i]);
  };
  std::vector<glm::dvec3> scaled(n);  // w h: what the columns of `rows` are for
  for (size_t i = 0; i < n; ++i) scaled[i] = glm::dvec3(scale(i));
  std::vector<double> power;
  for (int bounce = 0; bounce < bounces; ++bounce) {
    if (bounce > 0) {
      const std::vector<glm::vec3> arriving = multiply(rows, wavelet::forward(scaled));
      for (size_t i = 0; i < n; ++i)
        scaled[i] = scale(i) * glm::dvec3(in.cloud.samples[i].diffuse) * glm::dvec3(arriving[i]);
    }
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i)
      sum += static_cast<double>(in.cloud.area[i]) * luminance(scaled[i]) / scale(i);
    power.push_back(sum);
  }
  return power;
}

}  // namespace relight::direct_to_indirect
