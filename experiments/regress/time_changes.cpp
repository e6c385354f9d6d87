#include "experiments/regress/time_changes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace relight {
namespace {

// Below these a page fault counts; a precompute is timed once only.
constexpr double shortest_relight_ms = 0.5, shortest_precompute_s = 0.25;

using Stages = std::vector<std::pair<std::string, double>>;

// ", mostly stage transfer, 0.004 -> 0.041 s", or nothing if no stage is named in both.
std::string mostly(const Stages& was, const Stages& now) {
  const std::map<std::string, double> before(was.begin(), was.end());
  const std::pair<std::string, double>* most = nullptr;
  double largest = 0.0;
  for (const auto& stage : now) {
    const auto found = before.find(stage.first);
    if (found == before.end() || std::abs(stage.second - found->second) <= largest) continue;
    largest = std::abs(stage.second - found->second);
    most = &stage;
  }
  if (!most) return "";
  return fmt::format(", mostly stage {}, {:.4g} -> {:.4g} s", most->first, before.at(most->first),
                     most->second);
}

void add(const char* what, bool longer, const std::string& words, std::vector<Change>& out) {
  out.push_back({what, longer ? Weight::change : Weight::note, words});
}

void compare_relight(const RunRecord& was, const RunRecord& now, double tolerance, std::vector<Change>& out) {
  const RelightTime &a = was.relight_ms, &b = now.relight_ms;
  if (std::max(a.median, b.median) < shortest_relight_ms || a.min <= 0.0 || b.min <= 0.0) return;
  const bool longer = b.median > tolerance * a.median && b.min > tolerance * a.min;
  const bool shorter = a.median > tolerance * b.median && a.min > tolerance * b.min;
  if (!longer && !shorter) return;
  add("relight", longer,
      fmt::format("relight: {:.1f} -> {:.1f} ms ({:.1f}..{:.1f} -> {:.1f}..{:.1f}), {} by {:.2f}{}", a.median,
                  b.median, a.min, a.max, b.min, b.max, longer ? "slower" : "faster",
                  longer ? b.median / a.median : a.median / b.median,
                  mostly(was.relight_stages, now.relight_stages)),
      out);
}

void compare_precompute(const RunRecord& was, const RunRecord& now, double tolerance,
                        std::vector<Change>& out) {
  const double a = was.precompute_s, b = now.precompute_s;
  if (std::min(a, b) < 0.0 || std::max(a, b) < shortest_precompute_s) return;
  const bool longer = b > tolerance * a, shorter = a > tolerance * b;
  if (!longer && !shorter) return;
  add("precompute", longer,
      fmt::format("precompute: {:.2f} -> {:.2f} s, {} by {:.2f}{}", a, b, longer ? "slower" : "faster",
                  longer ? b / std::max(a, 1e-9) : a / std::max(b, 1e-9),
                  mostly(was.precompute_stages, now.precompute_stages)),
      out);
}

}  // namespace

std::string why_times_differ(const Provenance& was, const Provenance& now) {
  if (was.shared_machine || now.shared_machine)
    return fmt::format("{} runs shared the machine with others", was.shared_machine ? "published" : "fresh");
  if (was.cpu != now.cpu) return fmt::format("other machine: published on {}, now {}", was.cpu, now.cpu);
  if (was.threads != now.threads)
    return fmt::format("other number of threads: published {}, now {}", was.threads, now.threads);
  if (was.build_type != now.build_type)
    return fmt::format("other build: published {}, now {}", was.build_type, now.build_type);
  if (was.gl_renderer != now.gl_renderer)
    return fmt::format("other OpenGL: published {}, now {}", was.gl_renderer, now.gl_renderer);
  return "";
}

void compare_times(const RunRecord& was, const RunRecord& now, double tolerance, std::vector<Change>& out) {
  compare_relight(was, now, tolerance, out);
  compare_precompute(was, now, tolerance, out);
}

}  // namespace relight
