#include "experiments/compare/compare.h"

#include <list>

#include "experiments/compare/image_files.h"
#include "experiments/compare/method_record.h"
#include "experiments/compare/reference_images.h"
#include "experiments/compare/run_method.h"
#include "experiments/report/report.h"

namespace relight {

namespace {

// The references made so far; methods with equal light paths share one.
class References {
 public:
  References(const ComparePlan& plan, Session& session) : plan_(plan), session_(session) {}

  const ReferenceImages& find(const MethodPlan& method, StageLog& log) {
    const LightPaths paths = reference_paths(plan_, method);
    for (const ReferenceImages& made : made_) {
      if (same_paths(made.settings.paths, paths)) return made;
    }
    PathTracerSettings settings;
    settings.paths = paths;
    settings.samples_per_pixel = plan_.reference_samples;
    settings.estimator = plan_.reference_estimator;
    settings.seed = plan_.session.seed;
    made_.push_back(reference_images(session_, settings, log));
    return made_.back();
  }

 private:
  const ComparePlan& plan_;
  Session& session_;
  std::list<ReferenceImages> made_;  // a list: references handed out stay valid
};

RunRecord compare_method(const ComparePlan& plan, const MethodPlan& method, Session& session,
                         References& references) {
  RunRecord record = describe_run(plan, method, session);
  const MethodRun run = run_method(method, session, plan.repeats);
  add_costs(record, run, session);
  if (!run.failure.empty()) return record;
  StageLog reference_log;
  const ReferenceImages& reference = references.find(method, reference_log);
  add_errors(record, run.relit, reference, session);
  record.warnings.insert(record.warnings.end(), reference_log.warnings().begin(),
                         reference_log.warnings().end());
  write_run_images(plan.out, record.method, run.relit, reference.result,
                   {{"relight.scene", record.scene},
                    {"relight.lighting", record.lighting},
                    {"relight.method", record.method},
                    {"relight.command", record.command}});
  return record;
}

}  // namespace

std::vector<RunRecord> compare(const ComparePlan& plan) {
  Session session(plan.session, Session::Gpu::needed);
  const std::filesystem::path records_file = plan.out / "records.jsonl";
  std::filesystem::remove(records_file);
  References references(plan, session);
  std::vector<RunRecord> records;
  for (const MethodPlan& method : plan.methods) {
    records.push_back(compare_method(plan, method, session, references));
    append_record(records_file, records.back());
  }
  write_report(plan.out);
  return records;
}

}  // namespace relight
