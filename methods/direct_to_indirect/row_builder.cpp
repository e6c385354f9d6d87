#include "methods/direct_to_indirect/row_builder.h"

#include <algorithm>
#include <cmath>

namespace relight::direct_to_indirect {

void RowBuilder::add(RowScratch& scratch, const std::vector<LaneCoefficient>& coefficients, int t) {
  const std::array<const SurfaceSample*, lanes> samples = view_tiles_.samples(t);
  select_largest(coefficients, settings_.support_exponent, columns_, row_factors(samples),
                 candidate_limit(scratch), scratch.selection);
  for (size_t i = 0; i < lanes; ++i) {
    scratch.rows[i] = {};
    if (samples[i] && has_row(*samples[i])) scratch.rows[i] = select(scratch, i);
  }
  if (scratch.refit) scratch.refit->refit(coefficients, scratch.rows);
  TileRows& rows = tiles_[static_cast<size_t>(t)];
  for (size_t i = 0; i < lanes; ++i) {
    const std::vector<SparseEntry>& row = scratch.rows[i].entries;
    for (const SparseEntry& e : row)
      scratch.totals.energy_kept += static_cast<double>(e.value) * static_cast<double>(e.value);
    rows.entries.insert(rows.entries.end(), row.begin(), row.end());
    rows.end[i] = static_cast<uint32_t>(rows.entries.size());
  }
}

SparseRows RowBuilder::finish() {
  SparseRows rows;
  rows.columns = columns_;
  rows.row_start.push_back(0);
  size_t total = 0;
  for (const TileRows& t : tiles_) total += t.entries.size();
  rows.entries.reserve(total);
  const int width = buffer_.view.width;
  for (int y = 0; y < buffer_.view.height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto pixel = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      if (part_ == MatrixPart::glossy && !is_glossy(buffer_.indirect[pixel])) continue;
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

Lanes RowBuilder::row_factors(const std::array<const SurfaceSample*, lanes>& samples) const {
  Lanes factors;
  for (size_t i = 0; i < lanes; ++i)
    factors[i] = settings_.shared_budget && samples[i] ? row_factor(*samples[i], part_) : 1.0f;
  return factors;
}

// Of a row's coefficients no more are looked at.
size_t RowBuilder::candidate_limit(const RowScratch& scratch) const {
  return static_cast<size_t>(
      std::ceil(std::max(surplus(scratch), 1.0f) * static_cast<float>(settings_.row_limit(part_))));
}

// What the row keeps, or with a refit: what it may keep, and how many of them.
RefitRow RowBuilder::select(RowScratch& scratch, size_t lane) const {
  std::vector<Candidate>& candidates = scratch.selection.largest[lane];
  scratch.totals.before += scratch.selection.count[lane];
  scratch.totals.energy_before += scratch.selection.energy[lane];

  RefitRow row;
  row.target = candidates.size();
  if (settings_.shared_budget)
    row.target = static_cast<size_t>(std::count_if(
        candidates.begin(), candidates.end(), [this](const Candidate& c) { return c.weight > threshold_; }));
  row.target = std::min(row.target, settings_.row_limit(part_));
  if (settings_.energy_fraction < 1.0)
    row.target = std::min(
        row.target, count_for_energy(candidates, settings_.energy_fraction * scratch.selection.energy[lane]));
  keep_largest(candidates, static_cast<size_t>(surplus(scratch) * static_cast<float>(row.target)));
  for (const Candidate& c : candidates) row.entries.push_back(c.entry);
  return row;
}

}  // namespace relight::direct_to_indirect
