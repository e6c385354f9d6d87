#include "experiments/tables/points.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace relight::tables {
namespace {

void add_floor(Group& group, const RunRecord& record) {
  for (const ErrorKind error : all_errors) {
    const double floor = floor_of(record, error);
    Measured& all = group.noise_floors[static_cast<size_t>(error)];
    if (!std::isfinite(floor)) continue;
    if (!all.known()) all = {floor, floor, floor};
    all.low = std::min(all.low, floor);
    all.value = all.high = std::max(all.high, floor);
  }
}

}  // namespace

std::vector<std::string> Group::methods() const {
  std::vector<std::string> names;
  for (const Point& p : points)
    if (std::find(names.begin(), names.end(), p.method) == names.end()) names.push_back(p.method);
  return names;
}

std::string Group::title() const {
  return fmt::format("{}, {}, {}{}{}", scene, lighting, view, named_by_paths ? ", " : "",
                     named_by_paths ? paths : "");
}

std::string failure_of(const RunRecord& record) {
  if (!record.failed_stages.empty()) return fmt::format("{}", fmt::join(record.failed_stages, "; "));
  if (!record.errors || !record.errors_indirect) return "it has no errors: no picture, or no reference";
  if (record.errors->non_finite > 0)
    return fmt::format("{} pixels are not finite", record.errors->non_finite);
  if (!std::isfinite(record.errors->value.relative)) return "its relative error is not finite";
  if (record.relight_ms.repeats == 0) return "it was not timed";
  return "";
}

std::vector<Group> make_groups(const std::vector<RunRecord>& records) {
  const std::vector<std::string> names = labels(records);
  // A run that failed early has no paths; it stands with the first group of its scene, lighting and view.
  std::vector<Group> groups;
  const auto group_of = [&](const RunRecord& r) -> Group& {
    for (Group& g : groups)
      if (g.scene == r.scene && g.lighting == r.lighting && g.view == r.view &&
          (g.paths == r.reference_paths || r.reference_paths.empty()))
        return g;
    Group group;
    group.scene = r.scene, group.lighting = r.lighting, group.view = r.view, group.paths = r.reference_paths;
    return groups.emplace_back(std::move(group));
  };
  const auto add = [&](size_t i) {
    const RunRecord& r = records[i];
    Point point;
    point.record = i, point.method = r.method, point.label = names[i], point.failure = failure_of(r);
    for (const ErrorKind e : all_errors) point.errors[static_cast<size_t>(e)] = error_of(r, e);
    const auto bytes = static_cast<double>(prepared_bytes(r));
    point.costs = {relight_ms_of(r), Measured{bytes, bytes, bytes},
                   Measured{r.precompute_s, r.precompute_s, r.precompute_s}};
    Group& group = group_of(r);
    if (point.failure.empty()) add_floor(group, r);
    group.points.push_back(std::move(point));
  };
  for (size_t i = 0; i < records.size(); ++i)
    if (!records[i].reference_paths.empty()) add(i);
  for (size_t i = 0; i < records.size(); ++i)
    if (records[i].reference_paths.empty()) add(i);
  for (Group& a : groups)
    for (const Group& b : groups)
      if (&a != &b && a.scene == b.scene && a.lighting == b.lighting && a.view == b.view)
        a.named_by_paths = true;
  return groups;
}

}  // namespace relight::tables
