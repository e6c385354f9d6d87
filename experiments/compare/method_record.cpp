#include "experiments/compare/method_record.h"
#include "common/finite.h"

#include <cmath>

#include "common/run/error.h"
#include "common/run/peak_memory.h"
#include "common/scene/scene_file.h"
#include "experiments/compare/not_simulated.h"
#include "experiments/options/parse.h"

namespace relight {

namespace {

void report_non_finite(RunRecord& record, const char* name, const Image& image) {
  int64_t count = 0;
  size_t first = 0;
  for (size_t i = image.pixels.size(); i-- > 0;) {
    if (finite(image.pixels[i])) continue;
    ++count;
    first = i;
  }
  if (count == 0) return;
  const size_t width = static_cast<size_t>(image.width);
  record.failed_stages.push_back(fmt::format("{} image: {} pixels are not finite, the first at ({}, {})",
                                             name, count, first % width, first / width));
}

}  // namespace

RunRecord describe_run(const ComparePlan& plan, const MethodPlan& method, Session& session) {
  const Scene& scene = session.scene();
  const View& view = session.buffer().view;
  RunRecord record;
  record.scene = plan.session.scene;
  record.view = to_string(parse_view(plan.session.view));
  record.view_hash = view_hash(view);
  record.lighting = session.lighting_name();
  record.lighting_hash = lighting_hash(session.lighting());
  record.method = method.method->name();
  record.preset = method.preset;
  record.knobs = method.knobs.all();
  record.seed = plan.session.seed;
  record.repeatable = method.method->repeatable(method.knobs);
  const bool environment = session.has_environment();
  const LightPaths of_reference = reference_paths(plan, method);
  record.light_paths = (environment ? method.paths : method.paths.without_environment()).to_string();
  record.reference_paths = (environment ? of_reference : of_reference.without_environment()).to_string();
  record.not_simulated = not_simulated(method.paths, scene, session.lighting());
  record.width = view.width;
  record.height = view.height;
  record.exposure = static_cast<double>(scene.exposure);
  record.triangles = static_cast<int64_t>(scene.triangles.size());
  record.scene_hash = fmt::format("{:016x}", scene.content_hash);
  record.command = command_line(plan, session.lighting_name(), {method});
  record.provenance = collect_provenance(session.gpu()->renderer(), session.gpu()->version());
  record.provenance.shared_machine = plan.session.shared_machine;
  return record;
}

void add_costs(RunRecord& record, const MethodRun& run, const Session& session) {
  record.precompute_s = run.precompute_s;
  record.relight_ms = summarise_times(run.relight_ms);
  record.setup_stages = session.setup().stages();
  record.precompute_stages = run.precompute.stages();
  record.relight_stages = run.relight.stages();
  record.memory_bytes["process_peak"] = peak_memory_bytes();
  record.warnings = session.scene().repairs.warnings;
  for (const StageLog* log : {&run.precompute, &run.relight}) {
    for (const auto& [name, bytes] : log->bytes()) record.memory_bytes[name] = bytes;
    for (const auto& [name, count] : log->counters()) record.counters[name] += count;
    record.warnings.insert(record.warnings.end(), log->warnings().begin(), log->warnings().end());
  }
  if (!run.failure.empty()) record.failed_stages.push_back(run.failure);
}

void add_errors(RunRecord& record, const Relit& relit, const ReferenceImages& reference,
                const Session& session) {
  const PathTracerResult& result = reference.result;
  const auto& edge = session.buffer().edge;
  const float exposure = session.scene().exposure;
  record.errors = compare_images(relit.total, result.total(), result.indirect_variance, edge, exposure);
  record.errors_indirect =
      compare_images(relit.indirect, result.indirect, result.indirect_variance, edge, exposure);
  record.reference = ReferenceCost{};
  record.reference->samples = result.samples_per_pixel;
  record.reference->batches = result.batches;
  record.reference->seconds = reference.seconds;
  record.reference->rays = result.rays;
  record.reference->estimator = to_string(reference.settings.estimator);
  record.reference->from_cache = reference.from_cache;
  if (record.light_paths != record.reference_paths) {
    record.warnings.push_back(
        fmt::format("the method carries {} but was compared against {}: the error includes "
                    "light that it does not simulate",
                    record.light_paths, record.reference_paths));
  }
  report_non_finite(record, "direct", relit.direct);
  report_non_finite(record, "indirect", relit.indirect);
  report_non_finite(record, "total", relit.total);
  if (result.non_finite > 0) {
    record.failed_stages.push_back(
        fmt::format("reference: {} samples were not finite and were replaced by zero", result.non_finite));
  }
}

}  // namespace relight
