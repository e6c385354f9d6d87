#include "experiments/regress/changes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/regress/error_changes.h"
#include "experiments/regress/time_changes.h"

namespace relight {
namespace {

using Changes = std::vector<Change>;

void compare_failures(const RunRecord& was, const RunRecord& now, Changes& out) {
  if (!now.failed_stages.empty()) {
    const bool before = !was.failed_stages.empty();
    out.push_back(
        {"failed", before ? Weight::note : Weight::change,
         fmt::format("FAILED{}: {}", before ? ", as published" : "", fmt::join(now.failed_stages, "; "))});
  } else if (!was.failed_stages.empty()) {
    out.push_back({"failed", Weight::change,
                   fmt::format("no failure now; published: {}", fmt::join(was.failed_stages, "; "))});
  }
}

void compare_words(const char* what, const std::string& was, const std::string& now, Changes& out) {
  if (was != now)
    out.push_back({what, Weight::change, fmt::format("{}: published '{}', now '{}'", what, was, now)});
}

bool same_machine_and_gl(const Provenance& a, const Provenance& b) {
  return a.cpu == b.cpu && a.gl_renderer == b.gl_renderer && a.gl_version == b.gl_version;
}

// Exact on one machine. Floats may be rounded otherwise on another, and a threshold then counts one link
// more.
void compare_count(const std::string& name, int64_t was, int64_t now, bool same_machine, Changes& out) {
  if (was == now) return;
  const double share = std::abs(static_cast<double>(now - was)) / std::max(1.0, static_cast<double>(was));
  const bool rounding = !same_machine && share <= 1e-3;
  out.push_back({name, rounding ? Weight::note : Weight::change,
                 fmt::format("{}: {} -> {}{}", name, was, now,
                             rounding ? ", as far as rounding on another machine may go" : "")});
}

// What says how data were found, or how large the process was, is no property of the method.
bool of_the_method(const std::string& name) { return name != "cache_hits" && name != "process_peak"; }

void compare_counts(const std::string& prefix, const std::map<std::string, int64_t>& was,
                    const std::map<std::string, int64_t>& now, bool same_machine, Changes& out) {
  for (const auto& [name, n] : was) {
    if (!of_the_method(name)) continue;
    if (const auto found = now.find(name); found != now.end())
      compare_count(prefix + name, n, found->second, same_machine, out);
    else
      out.push_back({prefix + name, Weight::change, fmt::format("{}{}: {} -> gone", prefix, name, n)});
  }
  for (const auto& [name, n] : now)
    if (of_the_method(name) && !was.count(name))
      out.push_back({prefix + name, Weight::change, fmt::format("{}{}: new, {}", prefix, name, n)});
}

void note_new_knobs(const RunRecord& was, const RunRecord& now, Changes& out) {
  for (const auto& [knob, value] : now.knobs)
    if (!was.knobs.count(knob))
      out.push_back({"knobs", Weight::note, fmt::format("knob {} is new, {}", knob, value)});
  for (const auto& [knob, value] : was.knobs)
    if (!now.knobs.count(knob))
      out.push_back({"knobs", Weight::note, fmt::format("knob {} is gone, it was {}", knob, value)});
}

// Of what older records do not have. False if both are known and differ.
bool compare_known(const char* what, const std::string& was, const std::string& now, Changes& out) {
  if (was.empty() || now.empty() || was == now) return true;
  compare_words(what, was, now, out);
  return false;
}

}  // namespace

std::vector<Change> find_changes(const RunRecord& was, const RunRecord& now, const Tolerances& tolerances) {
  Changes out;
  compare_failures(was, now, out);
  note_new_knobs(was, now, out);
  compare_words("scene content", was.scene_hash, now.scene_hash, out);
  compare_words("light paths", was.light_paths, now.light_paths, out);
  compare_words("reference paths", was.reference_paths, now.reference_paths, out);
  const bool same_place = compare_known("camera or size", was.view_hash, now.view_hash, out) &
                          compare_known("lights", was.lighting_hash, now.lighting_hash, out);
  // Another scene, place or other paths explain whatever else differs.
  if (was.scene_hash != now.scene_hash || !same_place || was.reference_paths != now.reference_paths)
    return out;
  // Nothing was computed by a run that failed, or only half of it.
  const bool both_ran = was.failed_stages.empty() && now.failed_stages.empty();
  const bool by_the_clock = !was.repeatable || !now.repeatable;
  const std::string other_times = why_times_differ(was.provenance, now.provenance);
  if (by_the_clock && !other_times.empty()) {
    out.push_back({"budget", Weight::note,
                   "a time budget buys another picture on another machine: errors "
                   "and counters not compared"});
  } else {
    compare_errors(was, now, by_the_clock ? tolerances.time : 0.0, out);
    const bool same = same_machine_and_gl(was.provenance, now.provenance);
    if (both_ran && !by_the_clock) compare_counts("count.", was.counters, now.counters, same, out);
    if (both_ran) compare_counts("bytes.", was.memory_bytes, now.memory_bytes, same, out);
  }
  if (both_ran && other_times.empty()) compare_times(was, now, tolerances.time, out);
  return out;
}

}  // namespace relight
