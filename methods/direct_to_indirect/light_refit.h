// Chooses and refits the coefficients that truncated rows keep, so that their answers to a set of training
// lights come closest to those of the whole rows, relative to their size. Not in the paper.
//
// With G the responses of all coefficients to the training lights, c a whole row and w its truncated form, w
// minimises  |W (G^T w - G^T c)|^2 + ridge sum_k H_kk (w_k - c_k)^2  over the vectors with `target` non-zero
// entries among the row's candidates. H = G W^2 G^T is what the lights say about which coefficients are
// excited together, W = diag(1 / sqrt(y_t^2 + mean(y^2))) with y_t the root mean square answer to light t of
// the tile's rows. Dropped details are carried by kept coefficients that light usually excites together with
// them. The ridge shrinks the correlations, not the variances, of a finite number of lights (Ledoit and Wolf,
// "A well-conditioned estimator for large-dimensional covariance matrices", 2004, with the diagonal as the
// target), so that the training lights are not learned by heart: docs/accuracy.md has figures for others.
//
// Which candidates stay is decided by backward elimination: setting w_i to zero and letting the others adapt
// raises the objective by w_i^2 / (A^-1)_ii, A the matrix of the normal equations (the saliency of Hassibi
// and Stork, "Second order derivatives for network pruning: Optimal Brain Surgeon", 1992).
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "methods/direct_to_indirect/tile_gather.h"
#include "methods/direct_to_indirect/training_lights.h"

namespace relight::direct_to_indirect {

// What the refit chooses from for one row: columns ascending.
struct RefitRow {
  std::vector<SparseEntry> entries;
  size_t target = 0;  // entries to keep; no more than there are
};

// Scratch of one thread for the rows of one tile at a time.
class LightRefit {
 public:
  // `training` must outlive this; training.count > 0.
  LightRefit(const TrainingLights& training, float ridge);

  // all: every coefficient of the tile's rows; rows[i]: candidates of row i, reduced to their target in
  // place.
  void refit(const std::vector<LaneCoefficient>& all, std::array<RefitRow, lanes>& rows);

 private:
  const float* response(uint32_t column) const {
    return training_.response.data() + static_cast<size_t>(column) * training_.count;
  }
  void gather_answers(const std::vector<LaneCoefficient>& all);
  void weigh_lights();
  void gather_candidates(const std::array<RefitRow, lanes>& rows);
  void reduce(RefitRow& row, size_t lane);
  void set_up(const RefitRow& row, size_t lane);
  void solve();
  void drop_least(size_t count);

  const TrainingLights& training_;
  double ridge_;
  std::vector<float> answers_;      // lanes x lights
  std::vector<float> weights_;      // W
  std::vector<uint32_t> columns_;   // candidates of any row of the tile, ascending
  std::vector<float> block_;        // responses of a block of coefficients
  std::vector<float> packed_;       // weighted responses of columns_: columns x lights
  std::vector<float> gram_;         // columns x columns, lower triangle
  std::vector<float> right_sides_;  // columns x lanes
  // One row: indices into columns_ of what is left, whole row's values, ridge, right sides, solution, and the
  // normal equations' factor.
  std::vector<size_t> left_;
  std::vector<double> prior_, stiffness_, right_, solution_, matrix_;
  std::vector<std::pair<double, size_t>> saliency_;
};

}  // namespace relight::direct_to_indirect
