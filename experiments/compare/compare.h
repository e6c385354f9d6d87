// `relight compare`: runs every method of a plan, each against the reference restricted to its own light
// paths, and leaves images, records and a page behind.
#pragma once

#include <list>
#include <memory>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/compare/plan.h"
#include "experiments/compare/prepared_run.h"
#include "experiments/compare/reference_images.h"
#include "experiments/compare/run_method.h"
#include "experiments/session/session.h"

namespace relight {

// Writes into plan.out, replacing an earlier comparison's records.jsonl: EXR images (image_files.h),
// records.jsonl (a line as soon as a method is done) and index.html. A method that fails leaves a record with
// failed_stages; the others still run. Throws Error if scene, context or output fails.
std::vector<RunRecord> compare(const ComparePlan& plan);

// References that were made, with the settings of each; a list: references handed out stay valid.
using ReferenceStore = std::list<ReferenceImages>;

// A run of a comparison under way.
struct StartedRun {
  MethodPlan asked;  // before effects were planned
  RunRecord record;  // so far
  // Null if the effects could not be planned: the record says why.
  std::unique_ptr<PreparedRun> run;
};

// Compares one method after the other on one session. Methods with equal light paths share a reference.
class Comparison {
 public:
  // All must outlive this; of the plan, `methods` is not used and `out` only in the records' commands.
  Comparison(const ComparePlan& plan, Session& session, ReferenceStore& references)
      : plan_(plan), session_(session), references_(references), no_cache_(session.cache().folder(), false) {}
  // start, time_in_rounds of this run alone, finish.
  RunRecord run(const MethodPlan& method, const std::filesystem::path& folder);

  // Plans effects first if the plan says so, then prepares the method and warms it up.
  StartedRun start(const MethodPlan& method);
  // Errors, costs and images of a run that was timed; frees its prepared data. Writes the images into
  // `folder`. A method that fails makes a record with failed_stages; OutputError if the images cannot be
  // written.
  RunRecord finish(StartedRun started, const std::filesystem::path& folder);
  // The record alone, without effect planning and images: for searches over many settings.
  RunRecord measure(const MethodPlan& method);

 private:
  const ReferenceImages& reference(const MethodPlan& method, StageLog& log);
  // Costs, and errors against the reference that it returns; null: the run failed.
  const ReferenceImages* add_run(RunRecord& record, const MethodPlan& method, const MethodRun& run);
  void check_effects_of(const MethodPlan& asked, const MethodRun& run, RunRecord& record);

  const ComparePlan& plan_;
  Session& session_;
  ReferenceStore& references_;
  ArtefactCache no_cache_;
};

// The table printed at the end, which light paths were compared, what was left out, failures and warnings.
std::string summary_text(const std::vector<RunRecord>& records);

}  // namespace relight
