// Short names of runs: what tells one from the others of its method.
#include <map>
#include <set>

#include <fmt/format.h>

#include "experiments/tables/points.h"

namespace relight::tables {
namespace {

// Of one setting among the records of a method and preset: how often each value occurs.
struct Values {
  std::map<std::string, size_t> counts;
  size_t records = 0;
  void add(const std::string& value) { ++counts[value], ++records; }
  // A value that more than half of the records have goes without saying.
  bool telling(const std::string& value) const {
    const auto found = counts.find(value);
    return counts.size() > 1 && 2 * found->second <= records;
  }
};

std::string tolerance_of(const RunRecord& r) {
  return r.effect_plan ? fmt::format("{}", r.effect_plan->tolerance) : "";
}

}  // namespace

std::vector<std::string> labels(const std::vector<RunRecord>& records) {
  std::map<std::string, std::map<std::string, Values>> settings;  // method and preset -> knob -> values
  std::map<std::string, std::set<uint64_t>> seeds;
  const auto kind = [](const RunRecord& r) { return r.method + "\n" + r.preset + "\n" + tolerance_of(r); };
  for (const RunRecord& r : records) {
    for (const auto& [knob, value] : r.knobs) settings[kind(r)][knob].add(value);
    seeds[r.method].insert(r.seed);
  }
  std::vector<std::string> names;
  for (const RunRecord& r : records) {
    std::string name = r.preset;
    const auto add = [&](const std::string& text) { name += (name.empty() ? "" : " ") + text; };
    if (r.effect_plan) add("tolerance=" + tolerance_of(r));
    for (const auto& [knob, value] : r.knobs)
      if (settings[kind(r)][knob].telling(value)) add(knob + "=" + value);
    if (seeds[r.method].size() > 1) add(fmt::format("seed={}", r.seed));
    names.push_back(name);
  }
  // Records of another version of the method may lack a knob: then only their dates differ.
  const auto place = [&](size_t i) {
    const RunRecord& r = records[i];
    return fmt::format("{}\n{}\n{}\n{}\n{}", r.scene, r.lighting, r.view, r.method, names[i]);
  };
  std::map<std::string, size_t> same;
  for (size_t i = 0; i < records.size(); ++i) ++same[place(i)];
  std::vector<std::string> unique = names;
  for (size_t i = 0; i < records.size(); ++i)
    if (same[place(i)] > 1) unique[i] += " of " + records[i].provenance.date;
  return unique;
}

}  // namespace relight::tables
