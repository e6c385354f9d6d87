#include "experiments/compare/compare.h"

#include <algorithm>
#include <chrono>

#include "common/run/error.h"
#include "experiments/compare/effect_run.h"
#include "experiments/compare/image_files.h"
#include "experiments/compare/method_record.h"
#include "experiments/compare/run_method.h"
#include "experiments/report/report.h"
#include "experiments/session/output_folder.h"

namespace relight {

namespace {

bool sees_gloss(const DeepFrameBuffer& buffer) {
  const auto glossy = [](const SurfaceSample& s) { return s.valid && s.glossy != glm::vec3(0.0f); };
  return std::any_of(buffer.direct.begin(), buffer.direct.end(), glossy) ||
         std::any_of(buffer.indirect.begin(), buffer.indirect.end(), glossy);
}

}  // namespace

const ReferenceImages& Comparison::reference(const MethodPlan& method, StageLog& log) {
  LightPaths paths = reference_paths(plan_, method);
  // Where the view shows no gloss, or there is no environment, both sets of paths give one picture: it is
  // traced and kept once.
  paths.glossy_at_eye = paths.glossy_at_eye && sees_gloss(session_.buffer());
  if (!session_.has_environment()) paths = paths.without_environment();
  for (const ReferenceImages& made : references_) {
    if (same_paths(made.settings.paths, paths)) return made;
  }
  PathTracerSettings settings;
  settings.paths = paths;
  settings.samples_per_pixel = plan_.reference_samples;
  settings.estimator = plan_.reference_estimator;
  settings.seed = plan_.session.seed;
  references_.push_back(reference_images(session_, settings, log));
  return references_.back();
}

const ReferenceImages* Comparison::add_run(RunRecord& record, const MethodPlan& method,
                                           const MethodRun& run) {
  add_costs(record, run, session_);
  if (!run.failure.empty()) return nullptr;
  StageLog log;
  const ReferenceImages& made = reference(method, log);
  add_errors(record, run.relit, made, session_);
  for (const auto* warnings : {&made.warnings, &log.warnings()})
    record.warnings.insert(record.warnings.end(), warnings->begin(), warnings->end());
  return &made;
}

StartedRun Comparison::start(const MethodPlan& asked) {
  StartedRun started{asked, {}, nullptr};
  MethodPlan method = asked;
  std::optional<EffectPlan> effects;
  std::string failure;
  const double limit = plan_.time_limit_s;
  const auto start = std::chrono::steady_clock::now();
  try {
    if (limit > 0.0) session_.progress().set_limit(TimeLimit(limit, limit));
    if (plan_.effects) effects = plan_and_apply(*plan_.effects, method, session_);
  } catch (const Error& error) {
    failure = fmt::format("effect plan: {}", error.what());
  }
  session_.progress().set_limit(std::nullopt);
  const double used = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  started.record = describe_run(plan_, method, session_);
  started.record.effect_plan = std::move(effects);
  if (!failure.empty()) {
    started.record.failed_stages.push_back(failure);
    return started;
  }
  // Times beside those of everything on are compared without what earlier runs left in the cache.
  const bool timed = plan_.effects && plan_.effects->check;
  MethodSite site{session_.buffer(), timed ? no_cache_ : session_.cache()};
  if (limit > 0.0) site.time_limit_s = std::max(limit - used, 1e-9), site.whole_limit_s = limit;
  started.run = std::make_unique<PreparedRun>(method, session_, site, plan_.repeats);
  return started;
}

RunRecord Comparison::finish(StartedRun started, const std::filesystem::path& folder) {
  RunRecord& record = started.record;
  if (!started.run) return std::move(record);
  const MethodRun run = started.run->finish();
  const ReferenceImages* made = add_run(record, started.run->plan(), run);
  if (!made) return std::move(record);
  if (record.effect_plan) check_effects_of(started.asked, run, record);
  try {
    write_run_images(folder, record.method, run.relit, made->result,
                     {{"relight.scene", record.scene},
                      {"relight.lighting", record.lighting},
                      {"relight.method", record.method},
                      {"relight.command", record.command}});
  } catch (const Error& error) {
    throw OutputError(error.what());
  }
  return std::move(record);
}

RunRecord Comparison::run(const MethodPlan& method, const std::filesystem::path& folder) {
  StartedRun started = start(method);
  if (started.run) time_in_rounds({started.run.get()});
  return finish(std::move(started), folder);
}

RunRecord Comparison::measure(const MethodPlan& method) {
  RunRecord record = describe_run(plan_, method, session_);
  const MethodRun run = run_method(method, session_, plan_.repeats);
  add_run(record, method, run);
  return record;
}

void Comparison::check_effects_of(const MethodPlan& asked, const MethodRun& run, RunRecord& record) {
  try {
    check_plan(*plan_.effects, asked, run, plan_.reference_samples, plan_.repeats, session_, record);
  } catch (const Error& error) {
    record.failed_stages.push_back(fmt::format("effect check: {}", error.what()));
  }
}

std::vector<RunRecord> compare(const ComparePlan& plan) {
  Session session(plan.session, Session::Gpu::needed);
  const std::filesystem::path records_file = plan.out / "records.jsonl";
  std::filesystem::remove(records_file);
  ReferenceStore references;
  Comparison comparison(plan, session, references);
  std::vector<RunRecord> records;
  for (const MethodPlan& method : plan.methods) {
    records.push_back(comparison.run(method, plan.out));
    append_record(records_file, records.back());
  }
  write_report(plan.out);
  return records;
}

}  // namespace relight
