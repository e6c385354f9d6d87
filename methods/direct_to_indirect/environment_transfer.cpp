#include "methods/direct_to_indirect/environment_transfer.h"

#include <array>
#include <functional>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "methods/direct_to_indirect/environment_gather.h"
#include "methods/direct_to_indirect/lane_haar.h"
#include "methods/direct_to_indirect/selection.h"
#include "methods/direct_to_indirect/view_tiles.h"

namespace relight::direct_to_indirect {
namespace {

using Samples = std::array<const SurfaceSample*, lanes>;

// Scratch and counts of one worker thread.
struct Worker {
  std::vector<LaneCoefficient> elements, coefficients;
  LaneSelection selection;
  int64_t rays = 0, before = 0;
};

// The rows of one matrix, of which each tile's samples get theirs.
struct Rows {
  uint32_t columns;
  size_t limit;  // coefficients kept a row
  float support_exponent;
  std::vector<std::vector<SparseEntry>> entries;

  // Transforms and truncates worker.elements into the rows `row_of` names.
  template <typename RowOf>
  void add(Worker& worker, const Samples& samples, RowOf row_of) {
    worker.coefficients.clear();
    forward_lanes(worker.elements, columns, worker.coefficients);
    Lanes no_factor;
    no_factor.fill(1.0f);
    select_largest(worker.coefficients, support_exponent, columns, no_factor, limit, worker.selection);
    for (uint32_t i = 0; i < lanes; ++i) {
      if (!samples[i]) continue;
      worker.before += worker.selection.count[i];
      keep_largest(worker.selection.largest[i], limit);
      std::vector<SparseEntry>& row = entries[row_of(i)];
      for (const Candidate& c : worker.selection.largest[i]) row.push_back(c.entry);
    }
  }
  SparseRows finish() {
    SparseRows out;
    out.columns = columns;
    out.row_start.push_back(0);
    for (std::vector<SparseEntry>& row : entries) {
      out.entries.insert(out.entries.end(), row.begin(), row.end());
      out.row_start.push_back(out.entries.size());
      row = {};
    }
    return out;
  }
};

class Computation {
 public:
  Computation(const EnvironmentInput& input, const EnvironmentSettings& settings, Progress& progress)
      : in_(input),
        settings_(settings),
        progress_(progress),
        gather_(input.tracer, EnvironmentSquare(settings.samples), settings.seed) {}

  void view(EnvironmentTransfer& out) {
    const ViewTiles tiles(in_.buffer);
    const std::vector<uint32_t> glossy =
        settings_.glossy_rays > 0 ? glossy_pixels(in_.buffer) : std::vector<uint32_t>{};
    std::vector<uint32_t> glossy_row(in_.buffer.indirect.size(), 0);
    for (uint32_t r = 0; r < glossy.size(); ++r) glossy_row[glossy[r]] = r;
    Rows diffuse_rows = rows(settings_.coefficients, in_.buffer.indirect.size()),
         glossy_rows = rows(settings_.coefficients, glossy.size());
    const glm::vec3 eye = in_.buffer.view.camera.eye;
    run("environment on view samples", static_cast<size_t>(tiles.count()), [&](Worker& worker, size_t t) {
      if (!in_.tiles.empty() && !in_.tiles[t]) return;
      const Samples samples = tiles.samples(static_cast<int>(t));
      const auto pixel = [&](uint32_t i) {
        return static_cast<size_t>(samples[i] - in_.buffer.indirect.data());
      };
      gather_.elements(samples, t, worker.elements, worker.rays);
      diffuse_rows.add(worker, samples, pixel);
      Samples shiny = samples;
      for (const SurfaceSample*& s : shiny)
        if (s && (glossy.empty() || !is_glossy(*s))) s = nullptr;
      if (shiny == Samples{}) return;
      gather_.glossy_elements(shiny, eye, settings_.glossy_rays, t, worker.elements, worker.rays);
      glossy_rows.add(worker, shiny, [&](uint32_t i) { return glossy_row[pixel(i)]; });
    });
    out.view = diffuse_rows.finish();
    if (!glossy.empty()) out.glossy = glossy_rows.finish();
  }

  // Tiles are runs of samples in tree order: neighbours.
  void gather(EnvironmentTransfer& out) {
    const size_t samples = in_.cloud.samples.size(), tiles = (samples + lanes - 1) / lanes;
    Rows gather_rows = rows(settings_.gather_coefficients, samples);
    const uint64_t first_tile = uint64_t{1} << 32;  // other random directions than those of the view
    run("environment on gather samples", tiles, [&](Worker& worker, size_t t) {
      Samples members{};
      for (size_t i = 0; i < lanes && t * lanes + i < samples; ++i)
        members[i] = &in_.cloud.samples[t * lanes + i];
      gather_.elements(members, first_tile + t, worker.elements, worker.rays);
      gather_rows.add(worker, members, [&](uint32_t i) { return t * lanes + i; });
    });
    out.gather = gather_rows.finish();
  }

  void log_counts(const EnvironmentTransfer& out, StageLog& log) {
    int64_t rays = 0, before = 0;
    for (const Worker& w : workers_) rays += w.rays, before += w.before;
    log.count("environment_rays", rays);
    log.count("environment_coefficients_before_truncation", before);
    log.count("environment_non_zeros",
              static_cast<int64_t>(out.view.entries.size() + out.glossy.entries.size() +
                                   out.gather.entries.size()));
  }

 private:
  Rows rows(int limit, size_t count) const {
    return {gather_.texels(), static_cast<size_t>(limit), settings_.support_exponent,
            std::vector<std::vector<SparseEntry>>(count)};
  }
  void run(const char* what, size_t tiles, const std::function<void(Worker&, size_t)>& tile) {
    progress_.start(what, static_cast<int64_t>(tiles));
    tbb::parallel_for(size_t{0}, tiles, [&](size_t t) {
      tile(workers_.local(), t);
      progress_.advance();
    });
    progress_.finish();
  }

  const EnvironmentInput& in_;
  const EnvironmentSettings& settings_;
  Progress& progress_;
  EnvironmentGather gather_;
  tbb::enumerable_thread_specific<Worker> workers_;
};

}  // namespace

EnvironmentTransfer compute_environment_transfer(const EnvironmentInput& input,
                                                 const EnvironmentSettings& settings, Progress& progress,
                                                 StageLog& log) {
  EnvironmentTransfer out;
  Computation computation(input, settings, progress);
  computation.view(out);
  computation.gather(out);
  computation.log_counts(out, log);
  return out;
}

}  // namespace relight::direct_to_indirect
