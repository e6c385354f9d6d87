// The records of an experiment as one wide table.
#include <algorithm>
#include <functional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/options/csv_cell.h"
#include "experiments/run/run_experiment.h"

namespace relight {
namespace {

using Row = std::map<std::string, std::string>;

// Knobs that have more than one value among the records of their method.
std::set<std::string> varying_knobs(const std::vector<RunRecord>& records) {
  std::map<std::string, std::set<std::string>> values;
  for (const RunRecord& r : records)
    for (const auto& [knob, value] : r.knobs) values[r.method + "." + knob].insert(value);
  std::set<std::string> varying;
  for (const auto& [knob, all] : values)
    if (all.size() > 1) varying.insert(knob);
  return varying;
}

// Columns in the order in which they are first seen, with those of one kind together.
class Table {
 public:
  void set(Row& row, const std::string& column, const std::string& value) {
    if (std::find(columns_.begin(), columns_.end(), column) == columns_.end()) columns_.push_back(column);
    row[column] = value;
  }
  void set(Row& row, const std::string& column, double value) {
    set(row, column, fmt::format("{:.6g}", value));
  }
  void add(Row row) { rows_.push_back(std::move(row)); }
  std::string csv() const {
    std::string out = fmt::format("{}\n", fmt::join(columns_, ","));
    for (const Row& row : rows_) {
      std::vector<std::string> cells;
      for (const std::string& column : columns_) {
        const auto cell = row.find(column);
        cells.push_back(cell == row.end() ? "" : csv_cell(cell->second));
      }
      out += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return out;
  }

 private:
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
};

void add_what(Table& table, Row& row, const RunRecord& r, const std::set<std::string>& knobs) {
  table.set(row, "scene", r.scene);
  table.set(row, "lights", r.lighting);
  table.set(row, "view", r.view);
  table.set(row, "method", r.method);
  table.set(row, "preset", r.preset);
  table.set(row, "seed", std::to_string(r.seed));
  for (const auto& [knob, value] : r.knobs)
    if (knobs.count(r.method + "." + knob)) table.set(row, r.method + "." + knob, value);
}

// In per cent; half_width is of 95 % confidence.
void add_errors(Table& table, Row& row, const RunRecord& r) {
  if (!r.errors || !r.errors_indirect) return;
  table.set(row, "relative_percent", 100 * r.errors->value.relative);
  table.set(row, "relative_half_width", 100 * r.errors->half_width.relative);
  table.set(row, "edges_out_percent", 100 * r.errors->value.relative_edges_out);
  table.set(row, "indirect_percent", 100 * r.errors_indirect->value.relative);
  table.set(row, "indirect_hdr_percent", 100 * r.errors_indirect->value.relative_hdr);
  table.set(row, "noise_floor_percent", 100 * r.errors->noise_floor.relative);
  table.set(row, "edge_share_percent", 100 * r.errors->edge_share);
}

// What the effect planner left out, in per cent of the picture.
void add_effects(Table& table, Row& row, const RunRecord& r) {
  if (!r.effect_plan) return;
  const EffectPlan& plan = *r.effect_plan;
  table.set(row, "tolerance_percent", 100 * plan.tolerance);
  for (const EffectDecision& d : plan.effects) table.set(row, "effect." + d.effect, d.level);
  table.set(row, "left_out_predicted_percent", 100 * plan.loss.value);
  table.set(row, "plan_s", plan.seconds);
  if (!plan.check) return;
  table.set(row, "left_out_measured_percent", 100 * plan.check->measured.value);
  table.set(row, "plan_verdict", to_string(plan.check->verdict));
  if (const auto& all = plan.check->everything) {
    table.set(row, "everything.precompute_s", all->precompute_s);
    table.set(row, "everything.relight_ms", all->relight_ms);
    table.set(row, "everything.megabytes", 1e-6 * static_cast<double>(all->bytes));
    table.set(row, "planned.megabytes", 1e-6 * static_cast<double>(all->planned_bytes));
  }
}

void add_costs(Table& table, Row& row, const RunRecord& r) {
  table.set(row, "precompute_s", r.precompute_s);
  table.set(row, "relight_ms", r.relight_ms.median);
  table.set(row, "relight_min_ms", r.relight_ms.min);
  table.set(row, "relight_max_ms", r.relight_ms.max);
  if (r.relight_ms.median > 0) table.set(row, "frames_a_second", 1000 / r.relight_ms.median);
  for (const auto& [stage, seconds] : r.relight_stages)
    table.set(row, "relight." + stage + "_ms", 1000 * seconds);
  for (const auto& [stage, seconds] : r.precompute_stages)
    table.set(row, "precompute." + stage + "_s", seconds);
  for (const auto& [name, bytes] : r.memory_bytes)
    table.set(row, "megabytes." + name, 1e-6 * static_cast<double>(bytes));
  for (const auto& [name, count] : r.counters) table.set(row, "count." + name, std::to_string(count));
}

}  // namespace

std::string result_csv(const std::vector<RunRecord>& records) {
  const std::set<std::string> knobs = varying_knobs(records);
  Table table;
  // Kind by kind, so that all rows' columns of one kind stand together.
  std::vector<Row> rows(records.size());
  for (size_t i = 0; i < rows.size(); ++i) add_what(table, rows[i], records[i], knobs);
  for (size_t i = 0; i < rows.size(); ++i) add_errors(table, rows[i], records[i]);
  for (size_t i = 0; i < rows.size(); ++i) add_effects(table, rows[i], records[i]);
  for (size_t i = 0; i < rows.size(); ++i) add_costs(table, rows[i], records[i]);
  for (size_t i = 0; i < rows.size(); ++i) {
    const RunRecord& r = records[i];
    table.set(rows[i], "commit", r.provenance.commit + (r.provenance.dirty ? " dirty" : ""));
    table.set(rows[i], "cpu", r.provenance.cpu);
    table.set(rows[i], "failed", fmt::format("{}", fmt::join(r.failed_stages, "; ")));
    table.add(std::move(rows[i]));
  }
  return table.csv();
}

}  // namespace relight
