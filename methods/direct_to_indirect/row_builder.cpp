#include "methods/direct_to_indirect/row_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relight::direct_to_indirect {
namespace {

// Ties go to the smaller column, then to the earlier row.
bool heavier(const TileCandidate& a, const TileCandidate& b) {
  const Candidate &x = a.candidate, &y = b.candidate;
  if (x.weight != y.weight) return x.weight > y.weight;
  return std::pair(x.entry.column, a.lane) < std::pair(y.entry.column, b.lane);
}

void bring_heaviest_to_front(std::vector<TileCandidate>& candidates, size_t count) {
  if (count < candidates.size())
    std::nth_element(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count),
                     candidates.end(), heavier);
}

}  // namespace

void RowBuilder::add(RowScratch& scratch, const std::vector<LaneCoefficient>& coefficients, int t) {
  const bool transformed = basis_ && basis_->transformed(t);
  if (transformed) {
    scratch.transformed = coefficients;
    for (LaneCoefficient& c : scratch.transformed) wavelet::forward_tile(c.value);
    select_shared(scratch, scratch.transformed);
  } else {
    select_rows(scratch, coefficients, t);
  }
  if (scratch.refit) scratch.refit->refit(transformed ? scratch.transformed : coefficients, scratch.rows);
  TileRows& rows = tiles_[static_cast<size_t>(t)];
  for (size_t i = 0; i < lanes; ++i) {
    const std::vector<SparseEntry>& row = scratch.rows[i].entries;
    for (const SparseEntry& e : row)
      scratch.totals.energy_kept += static_cast<double>(e.value) * static_cast<double>(e.value);
    rows.entries.insert(rows.entries.end(), row.begin(), row.end());
    rows.end[i] = static_cast<uint32_t>(rows.entries.size());
  }
}

// Pixels in the order of the rows.
std::vector<uint32_t> RowBuilder::pixels_in_order() const {
  const int width = buffer_.view.width, height = buffer_.view.height;
  std::vector<uint32_t> order(static_cast<size_t>(width) * static_cast<size_t>(height));
  uint32_t pixel = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x, ++pixel) order[basis_ ? basis_->place(x, y) : pixel] = pixel;
  return order;
}

SparseRows RowBuilder::finish() {
  SparseRows rows;
  rows.columns = columns_;
  rows.row_start.push_back(0);
  size_t total = 0;
  for (const TileRows& t : tiles_) total += t.entries.size();
  rows.entries.reserve(total);
  const auto width = static_cast<uint32_t>(buffer_.view.width);
  for (const uint32_t pixel : pixels_in_order()) {
    if (part_ == MatrixPart::glossy && !is_glossy(buffer_.indirect[pixel])) continue;
    const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
    TileRows& t = tiles_[view_tiles_.tile_of(x, y)];
    const size_t lane = ViewTiles::lane_of(x, y);
    const std::ptrdiff_t first = lane == 0 ? 0 : t.end[lane - 1];
    rows.entries.insert(rows.entries.end(), t.entries.begin() + first, t.entries.begin() + t.end[lane]);
    rows.row_start.push_back(rows.entries.size());
    // Rows that keep every coefficient are large: they are let go as soon as they have been copied.
    if (--t.left == 0) t.entries = {};
  }
  return rows;
}

void RowBuilder::select_rows(RowScratch& scratch, const std::vector<LaneCoefficient>& coefficients,
                             int t) const {
  const std::array<const SurfaceSample*, lanes> samples = view_tiles_.samples(t);
  select_largest(coefficients, settings_.support_exponent, columns_, row_factors(samples),
                 candidate_limit(scratch), scratch.selection);
  for (size_t i = 0; i < lanes; ++i) {
    scratch.rows[i] = {};
    if (samples[i] && has_row(*samples[i])) scratch.rows[i] = select(scratch, i);
  }
}

// The heaviest coefficients of all rows of a transformed tile: as many as its rows could keep one by one.
void RowBuilder::select_shared(RowScratch& scratch, const std::vector<LaneCoefficient>& coefficients) const {
  const size_t budget = lanes * static_cast<size_t>(settings_.budget(part_));
  const auto limit = static_cast<size_t>(std::ceil(surplus(scratch) * static_cast<float>(budget)));
  Lanes ones;
  ones.fill(1.0f);
  select_largest(coefficients, settings_.support_exponent, columns_, ones, limit, scratch.selection);
  std::vector<TileCandidate>& candidates = scratch.of_tile;
  candidates.clear();
  for (uint32_t i = 0; i < lanes; ++i) {
    scratch.rows[i] = {};
    scratch.totals.before += scratch.selection.count[i];
    scratch.totals.energy_before += scratch.selection.energy[i];
    for (const Candidate& c : scratch.selection.largest[i]) candidates.push_back({c, i});
  }
  // Those to be kept before those that a refit may take instead, before the rest.
  bring_heaviest_to_front(candidates, limit);
  candidates.resize(std::min(limit, candidates.size()));
  bring_heaviest_to_front(candidates, budget);
  for (size_t n = 0; n < candidates.size(); ++n) {
    RefitRow& row = scratch.rows[candidates[n].lane];
    row.entries.push_back(candidates[n].candidate.entry);
    if (n < budget) ++row.target;
  }
  for (RefitRow& row : scratch.rows) std::ranges::sort(row.entries, {}, &SparseEntry::column);
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
