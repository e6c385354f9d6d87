#include "experiments/explain/explain.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "common/image/metrics.h"
#include "common/run/peak_memory.h"
#include "experiments/compare/method_record.h"
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

// What is run, in the order that makes the most of precomputed data: the cumulative chain, then each stage
// alone, first those that share the data of the chain's end.
struct Settings {
  MethodPlan all_exact;
  std::vector<MethodPlan> chain, alone;  // one an active stage
  std::vector<size_t> order;             // of alone
  std::vector<MethodPlan> closer;

  explicit Settings(const ExplainPlan& plan) : all_exact(with_exact(plan, active_stages(plan.stages))) {
    const std::vector<const ErrorStage*> active = active_stages(plan.stages);
    std::vector<const ErrorStage*> exact;
    for (const ErrorStage* stage : active) {
      exact.push_back(stage);
      chain.push_back(with_exact(plan, exact));
      std::vector<const ErrorStage*> others = active;
      std::erase(others, stage);
      order.push_back(alone.size());
      alone.push_back(with_exact(plan, others));
    }
    std::stable_partition(order.begin(), order.end(), [&](size_t i) {
      return alone[i].knobs.precompute_key() == all_exact.knobs.precompute_key();
    });
    if (!plan.closer) return;
    for (const ErrorStage& stage : plan.stages.closer) {
      closer.push_back(all_exact);
      closer.back().knobs = with_overrides(all_exact.knobs, stage);
    }
  }
  std::vector<MethodPlan> all(const MethodPlan& asked) const {
    std::vector<MethodPlan> out = {asked};
    for (const auto* list : {&chain, &alone, &closer}) out.insert(out.end(), list->begin(), list->end());
    return out;
  }
};

void run_settings(const ExplainPlan& plan, const Settings& settings, SettingRunner& runner,
                  WaterfallInput& input) {
  input.asked = runner.run("as asked", plan.method);
  std::vector<StageResults*> active;
  input.stages.reserve(plan.stages.stages.size());
  for (const ErrorStage& stage : plan.stages.stages) {
    input.stages.push_back({stage, {}, {}});
    if (!stage.active) continue;
    input.stages.back().exact = runner.run(stage.name + " exact", settings.chain[active.size()]);
    active.push_back(&input.stages.back());
  }
  for (const size_t i : settings.order)
    active[i]->alone = runner.run("all exact but " + active[i]->stage.name, settings.alone[i]);
  for (size_t i = 0; i < settings.closer.size(); ++i) {
    const ErrorStage& stage = plan.stages.closer[i];
    input.closer.emplace_back(stage, runner.run("all exact, " + stage.name, settings.closer[i]));
  }
}

PictureLayout layout_of(const DeepFrameBuffer& chosen, const PixelSubset& subset, float exposure) {
  PictureLayout layout;
  layout.edge = chosen.edge;
  layout.exposure = exposure;
  for (int y = 0; y < PixelSubset::side; ++y)
    for (const int block : subset.block) layout.block.insert(layout.block.end(), PixelSubset::side, block);
  return layout;
}

// Every light path. Russian roulette ends them; as long as they may be, they still are of finite length.
LightPaths every_path() {
  LightPaths paths;
  paths.max_bounces = 32;
  paths.glossy_at_eye = paths.glossy_interior = paths.environment = paths.emission = true;
  return paths;
}

// Warnings go to `run`.
PathTracerResult trace(const ExplainPlan& plan, const LightPaths& paths, Session& session,
                       const DeepFrameBuffer& chosen, RunRecord& run) {
  PathTracerSettings settings;
  settings.paths = session.has_environment() ? paths : paths.without_environment();
  settings.samples_per_pixel = plan.reference_samples;
  settings.seed = plan.session.seed;
  StageLog log;
  PathTracerResult result =
      path_trace(session.tracer(), chosen, session.lighting(), settings, session.progress(), log);
  run.warnings.insert(run.warnings.end(), log.warnings().begin(), log.warnings().end());
  return result;
}

Picture picture_of(const PathTracerResult& result) { return {result.total(), result.indirect}; }

// The same random numbers in both references, so that much of their noise is not in the difference.
ModelError model_error(const ExplainPlan& plan, const Picture& restricted, const PictureLayout& layout,
                       Session& session, const DeepFrameBuffer& chosen, RunRecord& run) {
  ModelError model;
  model.paths = every_path();
  const PathTracerResult every = trace(plan, model.paths, session, chosen, run);
  model.seconds = every.seconds;
  const Picture all = picture_of(every);
  for (size_t m = 0; m < measure_count; ++m) {
    const BlockSums sums = block_sums(restricted, all, all, layout, static_cast<Measure::Kind>(m));
    model.share[m] = share(sums), model.half_width[m] = half_width_of_drop(sums, {});
  }
  return model;
}

RunRecord describe(const ExplainPlan& plan, Session& session) {
  const ComparePlan same_run{plan.session,           {plan.method},           plan.out,    std::nullopt,
                             plan.reference_samples, Estimator::light_vertex, plan.repeats};
  RunRecord run = describe_run(same_run, plan.method, session);
  run.command = command_line(plan, session.lighting_name());
  run.setup_stages = session.setup().stages();
  run.warnings = session.scene().repairs.warnings;
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
  out.pixels_asked = plan.pixels;
  out.pixels = subset.pixels(), out.blocks = subset.block.back() + 1;
  out.pixel_share = static_cast<double>(out.pixels) / (static_cast<double>(view.width) * view.height);
  out.edge_share = static_cast<double>(std::count(chosen.edge.begin(), chosen.edge.end(), 1)) /
                   static_cast<double>(out.pixels);
  if (getloadavg(&out.load_average, 1) != 1) out.load_average = -1.0;

  WaterfallInput input;
  input.remainder = plan.stages.remainder, input.remainder_sentence = plan.stages.remainder_sentence;
  input.layout = layout_of(chosen, subset, session.scene().exposure);
  const PathTracerResult reference = trace(plan, plan.method.paths, session, chosen, out.run);
  out.run.reference = ReferenceCost{reference.samples_per_pixel,
                                    reference.batches,
                                    reference.seconds,
                                    reference.rays,
                                    to_string(Estimator::light_vertex),
                                    false};
  input.reference = picture_of(reference);
  out.model = model_error(plan, input.reference, input.layout, session, chosen, out.run);
  const Settings settings(plan);
  SettingRunner runner(session, subset, plan.repeats, settings.all(plan.method));
  out.shared_s = runner.warm_up(plan.method);
  run_settings(plan, settings, runner, input);
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
