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
//
// The work grows with the cube of a row's entries. Of a row with more than `largest_fit` those with the
// smallest answers c_k^2 H_kk keep their values, and the others are fitted to what these leave of the row's
// answers.
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
  // Above this the products of a tile's columns cost more than those of each row's. Rows of 100 coefficients
  // stay below, even where a tile of 16 shares them.
  static constexpr size_t default_largest_fit = 1600;

  // `training` must outlive this; training.count > 0. largest_fit: entries of a row that are fitted together,
  // and columns of a tile whose products its rows share; > 0.
  LightRefit(const TrainingLights& training, float ridge, size_t largest_fit = default_largest_fit);

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
  void multiply(const float* responses, size_t columns);
  void reduce(RefitRow& row, size_t lane);
  void set_up(const RefitRow& row, size_t lane);
  void fix_lightest(RefitRow& row, size_t lane);
  void multiply_row();
  void set_ridge();
  void solve();
  void drop_least(size_t count);
  float gram(size_t p, size_t q) const { return gram_[place_[p] * gram_columns_ + place_[q]]; }

  const TrainingLights& training_;
  double ridge_;
  size_t largest_fit_;
  std::vector<float> answers_;      // lanes x lights
  std::vector<float> weights_;      // W
  std::vector<uint32_t> columns_;   // candidates of any row of the tile, ascending
  std::vector<float> block_;        // responses of a block of coefficients
  std::vector<float> packed_;       // weighted responses of columns_: columns x lights
  std::vector<float> right_sides_;  // columns x lanes
  std::vector<float> gram_;  // H, lower triangle: of columns_, or of one row's if the tile has too many
  size_t gram_columns_ = 0;
  // One row: what is left as indices into columns_ and into H, the whole row's values, ridge, right sides,
  // solution, and the normal equations' factor; then what keeps its value.
  std::vector<size_t> left_, place_;
  std::vector<double> prior_, stiffness_, right_, solution_, matrix_;
  std::vector<std::pair<double, size_t>> saliency_;
  std::vector<SparseEntry> fixed_;
  std::vector<float> residual_, row_responses_;  // answers that fixed_ leaves; responses of left_
};

}  // namespace relight::direct_to_indirect
