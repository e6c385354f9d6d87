#include "experiments/tables/sequences.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "experiments/options/parse.h"

namespace relight::tables {
namespace {

constexpr ErrorKind shown_errors[] = {ErrorKind::relative, ErrorKind::indirect};

std::vector<TableCell> row(const Sequence& s) {
  std::vector<TableCell> cells{text_cell(s.scene), text_cell(s.lighting),
                               text_cell(s.view),  text_cell(s.method),
                               text_cell(s.label), text_cell(std::to_string(s.times.size()))};
  cells.back().value = static_cast<double>(s.times.size());
  for (const ErrorKind error : shown_errors) {
    const double mean = s.mean(error);
    const size_t worst = s.worst(error);
    const double largest = (*s.points[worst])[error].value;
    cells.push_back({error_text(mean), 100 * mean, "", ""});
    cells.push_back(
        {fmt::format("{} at {:g} s", error_text(largest), s.times[worst]), 100 * largest, "", ""});
  }
  double sum = 0.0, slowest = 0.0;
  for (const Point* p : s.points) {
    const double ms = (*p)[CostKind::relight].value;
    sum += ms, slowest = std::max(slowest, ms);
  }
  const double mean_ms = sum / static_cast<double>(s.points.size());
  cells.push_back({cost_text(CostKind::relight, mean_ms), mean_ms, "", ""});
  cells.push_back({cost_text(CostKind::relight, slowest), slowest, "", ""});
  return cells;
}

void sort_by_time(Sequence& s) {
  std::vector<size_t> order(s.times.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return s.times[a] < s.times[b]; });
  Sequence sorted = s;
  for (size_t i = 0; i < order.size(); ++i)
    sorted.times[i] = s.times[order[i]], sorted.points[i] = s.points[order[i]];
  s = std::move(sorted);
}

}  // namespace

double Sequence::mean(ErrorKind error) const {
  double sum = 0.0;
  for (const Point* p : points) sum += (*p)[error].value;
  return sum / static_cast<double>(points.size());
}

size_t Sequence::worst(ErrorKind error) const {
  size_t worst = 0;
  for (size_t i = 1; i < points.size(); ++i) {
    const double value = (*points[i])[error].value, largest = (*points[worst])[error].value;
    if (value > largest || (std::isnan(largest) && !std::isnan(value))) worst = i;
  }
  return worst;
}

std::vector<Sequence> sequences(const std::vector<Group>& groups) {
  std::vector<Sequence> all;
  std::map<std::tuple<std::string, std::string, std::string, std::string, std::string, std::string>, size_t>
      places;
  for (const Group& group : groups) {
    const LightsChoice lights = parse_lights(group.lighting);
    if (lights.times.size() != 1) continue;
    for (const Point& p : group.points) {
      if (!p.failure.empty()) continue;
      const auto [at, is_new] = places.try_emplace(
          std::tuple(group.scene, lights.name, group.view, group.paths, p.method, p.label), all.size());
      if (is_new)
        all.push_back({group.scene, lights.name, group.view, group.paths, p.method, p.label, {}, {}});
      all[at->second].times.push_back(lights.times.front());
      all[at->second].points.push_back(&p);
    }
  }
  std::erase_if(all, [](const Sequence& s) { return s.times.size() < 2; });
  for (Sequence& s : all) sort_by_time(s);
  return all;
}

Table sequence_table(const Results& results) {
  Table table{"sequences", "Light sequences", {}, {}, ""};
  for (const char* name : {"scene", "lights", "view", "method", "run"})
    table.columns.push_back({name, false});
  for (const char* name : {"moments", "relative, mean %", "largest %", "indirect, mean %", "largest %",
                           "relight, mean (ms)", "slowest (ms)"})
    table.columns.push_back({name, true});
  for (const Sequence& s : sequences(results.groups)) table.rows.push_back(row(s));
  table.note =
      "Runs that differ in the moment of a moving lighting alone; each moment has its own reference.";
  return table;
}

}  // namespace relight::tables
