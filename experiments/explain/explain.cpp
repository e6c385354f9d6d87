#include "experiments/explain/explain.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "common/image/metrics.h"
#include "common/run/peak_memory.h"
#include "experiments/compare/not_simulated.h"
#include "reference/path_tracer.h"

namespace relight {
namespace {

MethodPlan with_exact(const ExplainPlan& plan, const std::vector<const ErrorStage*>& stages) {
  MethodPlan method = plan.method;
  for (const ErrorStage* stage : stages) method.knobs = with_overrides(method.knobs, *stage);
  return method;
}

std::vector<const ErrorStage*> active_stages(const ErrorStages& stages) {
  std::vector<const ErrorStage*> active;
  for (const ErrorStage& stage : stages.stages)
    if (stage.active) active.push_back(&stage);
  return active;
}

// Runs the cumulative chain, then each stage alone: first those whose precomputed data the chain's end left
// in memory.
void run_settings(const ExplainPlan& plan, SettingRunner& runner, WaterfallInput& input) {
  const std::vector<const ErrorStage*> active = active_stages(plan.stages);
  const MethodPlan all_exact = with_exact(plan, active);
  input.asked = runner.run("as asked", plan.method);
  std::vector<const ErrorStage*> exact;
  for (const ErrorStage& stage : plan.stages.stages) {
    input.stages.push_back({stage, {}, {}});
    if (!stage.active) continue;
    exact.push_back(&stage);
    input.stages.back().exact = runner.run(stage.name + " exact", with_exact(plan, exact));
  }
  std::vector<std::pair<StageResults*, MethodPlan>> alone;
  for (StageResults& results : input.stages) {
    if (!results.exact) continue;
    std::vector<const ErrorStage*> others = active;
    std::erase_if(others, [&](const ErrorStage* s) { return s->name == results.stage.name; });
    alone.emplace_back(&results, with_exact(plan, others));
  }
  std::stable_partition(alone.begin(), alone.end(), [&](const auto& a) {
    return a.second.knobs.precompute_key() == all_exact.knobs.precompute_key();
  });
  for (auto& [results, method] : alone)
    results->alone = runner.run("all exact but " + results->stage.name, method);
  if (!plan.closer) return;
  for (const ErrorStage& stage : plan.stages.closer) {
    MethodPlan method = all_exact;
    method.knobs = with_overrides(method.knobs, stage);
    input.closer.emplace_back(stage, runner.run("all exact, " + stage.name, method));
  }
}

int number_of_settings(const ExplainPlan& plan) {
  const auto active = static_cast<int>(active_stages(plan.stages).size());
  return 1 + 2 * active + (plan.closer ? static_cast<int>(plan.stages.closer.size()) : 0);
}

PictureLayout layout_of(const DeepFrameBuffer& chosen, const PixelSubset& subset, float exposure) {
  PictureLayout layout;
  layout.edge = chosen.edge;
  layout.exposure = exposure;
  for (int y = 0; y < PixelSubset::side; ++y)
    for (const int block : subset.block) layout.block.insert(layout.block.end(), PixelSubset::side, block);
  return layout;
}

PathTracerResult trace_reference(const ExplainPlan& plan, Session& session, const DeepFrameBuffer& chosen,
                                 RunRecord& run) {
  PathTracerSettings settings;
  settings.paths = plan.method.paths;
  settings.samples_per_pixel = plan.reference_samples;
  settings.seed = plan.session.seed;
  StageLog log;
  PathTracerResult result =
      path_trace(session.tracer(), chosen, session.lighting(), settings, session.progress(), log);
  run.reference = ReferenceCost{result.samples_per_pixel,      result.batches, result.seconds, result.rays,
                                to_string(settings.estimator), false};
  run.warnings.insert(run.warnings.end(), log.warnings().begin(), log.warnings().end());
  return result;
}

RunRecord describe(const ExplainPlan& plan, Session& session) {
  const Scene& scene = session.scene();
  RunRecord run;
  run.scene = plan.session.scene, run.view = plan.session.view, run.lighting = session.lighting_name();
  run.method = plan.method.method->name(), run.knobs = plan.method.knobs.all();
  run.seed = plan.session.seed;
  run.light_paths = run.reference_paths = plan.method.paths.to_string();
  run.not_simulated = not_simulated(plan.method.paths, scene);
  run.command = command_line(plan, session.lighting_name());
  run.exposure = static_cast<double>(scene.exposure);
  run.width = session.buffer().view.width, run.height = session.buffer().view.height;
  run.triangles = static_cast<int64_t>(scene.triangles.size());
  run.scene_hash = fmt::format("{:016x}", scene.content_hash);
  run.setup_stages = session.setup().stages();
  run.warnings = scene.repairs.warnings;
  run.provenance = collect_provenance(session.gpu()->renderer(), session.gpu()->version());
  return run;
}

}  // namespace

Explanation explain(const ExplainPlan& plan) {
  Session session(plan.session, Session::Gpu::needed);
  const View& view = session.buffer().view;
  const PixelSubset subset =
      choose_pixels(view.width, view.height, plan.pixels, plan.block, plan.session.seed);
  const DeepFrameBuffer chosen = compact(session.buffer(), subset);
  Explanation out;
  out.run = describe(plan, session);
  out.pixels = subset.pixels(), out.blocks = subset.block.back() + 1;
  out.pixel_share = static_cast<double>(out.pixels) / (static_cast<double>(view.width) * view.height);
  out.edge_share = static_cast<double>(std::count(chosen.edge.begin(), chosen.edge.end(), 1)) /
                   static_cast<double>(out.pixels);
  if (getloadavg(&out.load_average, 1) != 1) out.load_average = -1.0;

  WaterfallInput input;
  input.remainder = plan.stages.remainder, input.remainder_sentence = plan.stages.remainder_sentence;
  input.layout = layout_of(chosen, subset, session.scene().exposure);
  const PathTracerResult reference = trace_reference(plan, session, chosen, out.run);
  input.reference = {reference.total(), reference.indirect};
  SettingRunner runner(session, subset, plan.repeats, number_of_settings(plan));
  out.shared_s = runner.warm_up(plan.method);
  run_settings(plan, runner, input);
  out.settings = runner.records();
  out.waterfall = make_waterfall(input);

  const float exposure = session.scene().exposure;
  out.run.errors = compare_images(input.asked.picture.total, input.reference.total,
                                  reference.indirect_variance, chosen.edge, exposure);
  out.run.errors_indirect = compare_images(input.asked.picture.indirect, input.reference.indirect,
                                           reference.indirect_variance, chosen.edge, exposure);
  out.run.precompute_s = out.settings.front().precompute_s;
  out.run.relight_ms = out.settings.front().relight_ms;
  out.run.precompute_stages = out.settings.front().precompute_stages;
  out.run.relight_stages = out.settings.front().relight_stages;
  out.run.memory_bytes["process_peak"] = peak_memory_bytes();
  out.run.warnings.insert(out.run.warnings.end(), runner.warnings().begin(), runner.warnings().end());
  return out;
}

}  // namespace relight
