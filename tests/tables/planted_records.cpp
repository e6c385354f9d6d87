#include "planted_records.h"

#include <stdexcept>

namespace relight::test {

RunRecord planted(const std::string& method, const std::string& preset, double error, double half, double ms,
                  double megabytes, double precompute_s) {
  RunRecord r;
  r.scene = "box", r.lighting = "spot", r.view = "64x48";
  r.width = 64, r.height = 48;
  r.method = method, r.preset = preset;
  r.seed = 1;
  r.knobs = {{"preset_knob", preset}};
  r.light_paths = r.reference_paths = "E D D L, 1 bounce, local lights";
  r.command = "relight compare --methods " + method + " --preset " + preset;
  r.errors.emplace();
  r.errors->value.relative = error, r.errors->half_width.relative = half;
  r.errors->value.relative_edges_out = 0.5 * error, r.errors->half_width.relative_edges_out = 0.5 * half;
  r.errors->noise_floor.relative = r.errors->noise_floor.relative_edges_out = 0.001;
  r.errors_indirect = r.errors;
  r.errors_indirect->value.relative = 2 * error, r.errors_indirect->half_width.relative = 2 * half;
  r.relight_ms = {ms, 0.9 * ms, 1.1 * ms, 5};
  r.precompute_s = precompute_s;
  r.memory_bytes = {{"matrix", static_cast<int64_t>(1e6 * megabytes)}, {"process_peak", 1'000'000'000}};
  r.provenance.commit = "0123abcd", r.provenance.cpu = "a processor", r.provenance.threads = 2;
  r.provenance.gl_renderer = "llvmpipe", r.provenance.date = "2026-01-01T00:00:00Z";
  return r;
}

RunRecord planted_failure(const std::string& method, const std::string& why) {
  RunRecord r = planted(method, "paper", 0, 0, 1);
  r.errors.reset(), r.errors_indirect.reset();
  r.relight_ms = {};
  r.failed_stages = {why};
  return r;
}

std::vector<RunRecord> planted_methods() {
  std::vector<RunRecord> all{planted("exact", "paper", 0.01, 0.001, 10),
                             planted("too_dark", "paper", 0.03, 0.001, 10),
                             planted("leaks_nan", "paper", 0.0, 0.0, 1),
                             planted("slow", "paper", 0.01, 0.001, 100),
                             planted("path_tracing", "paper", 0.5, 0.001, 11, 0, 0),
                             planted("path_tracing", "long", 0.005, 0.001, 1000, 0, 0)};
  all[1].errors->value.bias = -0.03, all[1].errors->half_width.bias = 0.0001;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  all[2].errors->value.relative = nan, all[2].errors->non_finite = 1;
  all[2].failed_stages = {"total image: 1 pixels are not finite, the first at (3, 2)"};
  return all;
}

tables::Group group_of(const std::vector<RunRecord>& records) {
  const auto groups = tables::make_groups(records);
  if (groups.size() != 1) throw std::logic_error("not one group");
  return groups.front();
}

}  // namespace relight::test
