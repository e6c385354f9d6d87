// Refits the kept coefficients of truncated rows so that their answers to a set of training lights come
// closest to those of the whole rows, relative to their size. Not in the paper.
//
// With G the responses of all coefficients to the training lights, c a whole row and c_S what is kept of it,
// the correction d minimises  |W (G_S^T (c_S + d) - G^T c)|^2 + mu |d|^2,  mu = ridge x mean diagonal of
// G_S W^2 G_S^T, W = diag(1 / sqrt(y_t^2 + mean(y^2))) with y_t the root mean square answer to light t of the
// tile's rows: dropped details are carried by kept coefficients that light usually excites together with
// them. The ridge keeps it from learning the training lights by heart (docs/accuracy.md has figures for other
// lights).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "methods/direct_to_indirect/tile_gather.h"
#include "methods/direct_to_indirect/training_lights.h"

namespace relight::direct_to_indirect {

// Scratch of one thread for the rows of one tile at a time.
class LightRefit {
 public:
  // `training` must outlive this; training.count > 0.
  LightRefit(const TrainingLights& training, float ridge);

  // all: every coefficient of the tile's rows; kept[i]: what row i keeps of it, changed in place.
  void refit(const std::vector<LaneCoefficient>& all, const std::array<std::span<SparseEntry>, lanes>& kept);

 private:
  const float* response(uint32_t column) const {
    return training_.response.data() + static_cast<size_t>(column) * training_.count;
  }
  void gather_residual(const std::vector<LaneCoefficient>& all);
  void weigh_lights();
  void gather_kept(const std::array<std::span<SparseEntry>, lanes>& kept);
  void solve(std::span<SparseEntry> row, size_t lane);

  const TrainingLights& training_;
  double ridge_;
  std::vector<float> residual_;    // lanes x lights
  std::vector<float> weights_;     // W
  std::vector<uint32_t> columns_;  // kept by any row of the tile, ascending
  std::vector<float> block_;       // responses of a block of coefficients
  std::vector<float> packed_;      // responses of columns_: columns x lights
  std::vector<float> gram_;        // columns x columns, lower triangle
  std::vector<float> target_;      // columns x lanes
  std::vector<float> values_;      // columns x lanes: kept values
  std::vector<double> matrix_, right_;
};

}  // namespace relight::direct_to_indirect
