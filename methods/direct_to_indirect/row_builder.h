// The rows of one final-gather matrix, made tile by tile from all coefficients of their walk: truncated,
// refitted if asked for, and collected in the order of the pixels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "common/wavelet/picture_haar.h"
#include "methods/direct_to_indirect/final_gather.h"
#include "methods/direct_to_indirect/light_refit.h"
#include "methods/direct_to_indirect/selection.h"
#include "methods/direct_to_indirect/view_tiles.h"

namespace relight::direct_to_indirect {

// Reported only: the sums of energy may differ in the last bits between runs.
struct RowTotals {
  int64_t before = 0;  // coefficients before truncation
  double energy_before = 0, energy_kept = 0;

  RowTotals& operator+=(const RowTotals& other) {
    before += other.before;
    energy_before += other.energy_before, energy_kept += other.energy_kept;
    return *this;
  }
};

// A coefficient of one of a tile's rows.
struct TileCandidate {
  Candidate candidate;
  uint32_t lane;
};

// Scratch of one worker thread.
struct RowScratch {
  std::vector<LaneCoefficient> transformed;  // with a basis, like of_tile
  std::vector<TileCandidate> of_tile;
  std::optional<LightRefit> refit;  // none: coefficients stay as they are
  std::array<RefitRow, lanes> rows;
  LaneSelection selection;
  RowTotals totals;
};

class RowBuilder {
 public:
  // threshold: of shared_budget_threshold; used with settings.shared_budget only. basis: of the rows
  // (view_basis.h), or null.
  RowBuilder(const DeepFrameBuffer& buffer, const FinalGatherSettings& settings, MatrixPart part,
             uint32_t columns, float threshold, const wavelet::PictureHaar* basis = nullptr)
      : buffer_(buffer),
        settings_(settings),
        part_(part),
        columns_(columns),
        threshold_(threshold),
        basis_(basis),
        view_tiles_(buffer),
        tiles_(static_cast<size_t>(view_tiles_.count())) {}

  // `coefficients`: all of the rows of tile t. Tiles may be added by several threads, each with its scratch.
  void add(RowScratch& scratch, const std::vector<LaneCoefficient>& coefficients, int t);
  // To be called once. One row for each pixel, or of the glossy matrix one for each glossy pixel; with a
  // basis in its order.
  SparseRows finish();

 private:
  // The rows of one tile's lanes, one after the other; lane i ends at end[i].
  struct TileRows {
    std::vector<SparseEntry> entries;
    std::array<uint32_t, lanes> end{};
    int left = lanes;  // that finish() has not collected
  };
  bool has_row(const SurfaceSample& sample) const {
    return part_ == MatrixPart::diffuse ? sample.valid : is_glossy(sample);
  }
  Lanes row_factors(const std::array<const SurfaceSample*, lanes>& samples) const;
  size_t candidate_limit(const RowScratch& scratch) const;
  float surplus(const RowScratch& scratch) const { return scratch.refit ? settings_.refit_candidates : 1.0f; }
  RefitRow select(RowScratch& scratch, size_t lane) const;
  void select_rows(RowScratch& scratch, const std::vector<LaneCoefficient>& coefficients, int t) const;
  void select_shared(RowScratch& scratch, const std::vector<LaneCoefficient>& coefficients) const;
  std::vector<uint32_t> pixels_in_order() const;

  const DeepFrameBuffer& buffer_;
  const FinalGatherSettings& settings_;
  MatrixPart part_;
  uint32_t columns_;
  float threshold_;
  const wavelet::PictureHaar* basis_;
  ViewTiles view_tiles_;
  std::vector<TileRows> tiles_;
};

}  // namespace relight::direct_to_indirect
