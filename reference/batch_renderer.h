// Renders batches of indirect light samples into per-pixel statistics. Every pixel's numbers depend on seed,
// place and batch only, and each pixel adds its batches in order: the result is the same for any number of
// threads.
//
// The pixels of a 4x4 tile share their light vertices (packets of shadow rays), so their errors are
// correlated; different tiles are independent.
#pragma once

#include <atomic>
#include <vector>

#include "reference/path_sampler.h"
#include "reference/path_tracer.h"
#include "reference/path_tracer_state.h"

namespace relight {

class BatchRenderer {
 public:
  BatchRenderer(const PathSampler& sampler, const RayTracer& tracer, const DeepFrameBuffer& buffer,
                const PathTracerSettings& settings, int samples_per_batch);

  // Traces some samples that count for nothing else, and from their spread chooses how many paths each tile
  // traces per sample: as many as its standard deviation is times the mean, because that gives the least
  // noise for the time. (Chosen from the samples themselves, it would bias the result.)
  void plan(int samples);

  // Tasks a batch; progress advances by one a task.
  int tasks() const;
  // The next batch.
  void render(Progress& progress);

  // What has been rendered so far; may be replaced by an earlier state of the same settings before the next
  // batch.
  const PathTracerState& state() const { return state_; }
  // Has it as many tiles, pixels and path classes?
  bool fits(const PathTracerState& state) const {
    return state.paths.size() == state_.paths.size() && state.pixels.size() == state_.pixels.size() &&
           state.layers.size() == state_.layers.size();
  }
  void resume(PathTracerState state) { state_ = std::move(state); }

 private:
  struct Tile;
  struct Counts {
    int64_t rays = 0, non_finite = 0;
  };
  void render_row(int row, int batch);
  Tile make_tile(int x0, int y0, uint64_t sequence, int paths) const;
  const EyeTile& eye_tile(Tile& tile, uint32_t sub) const;
  int& paths_of(int x0, int y0);
  void render_tile(int x0, int y0, int batch, Counts& counts);
  void sample_tile(Tile& tile, uint32_t index, Counts& counts) const;
  bool add_sample(Tile& tile, int pixel, const glm::vec3* values) const;

  const PathSampler& sampler_;
  const RayTracer& tracer_;
  const DeepFrameBuffer& buffer_;
  const PathTracerSettings& settings_;
  int samples_;
  int tiles_x_, tiles_y_;
  PathTracerState state_;
  std::atomic<int64_t> rays_{0}, non_finite_{0};  // of the batch being rendered
};

}  // namespace relight
