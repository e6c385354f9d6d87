// `relight compare`: runs every method of a plan, each against the reference restricted to its own light
// paths, and leaves images, records and a page behind.
#pragma once

#include <list>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/compare/plan.h"
#include "experiments/compare/reference_images.h"
#include "experiments/compare/run_method.h"
#include "experiments/session/session.h"

namespace relight {

// Writes into plan.out, replacing an earlier comparison's records.jsonl: EXR images (image_files.h),
// records.jsonl (a line as soon as a method is done) and index.html. A method that fails leaves a record with
// failed_stages; the others still run. Throws Error if scene, context or output fails.
std::vector<RunRecord> compare(const ComparePlan& plan);

// Compares one method after the other on one session. Methods with equal light paths share a reference.
class Comparison {
 public:
  // Both must outlive this; of the plan, `methods` is not used and `out` only in the records' commands.
  Comparison(const ComparePlan& plan, Session& session) : plan_(plan), session_(session) {}
  // Plans effects first if the plan says so. Writes the images into `folder`. A method that fails makes a
  // record with failed_stages; Error if the images cannot be written.
  RunRecord run(const MethodPlan& method, const std::filesystem::path& folder);

  // The record alone, without effect planning and images: for searches over many settings. `cache`: of precomputed
  // data; the session's keeps the reference.
  RunRecord measure(const MethodPlan& method, ArtefactCache& cache);

 private:
  const ReferenceImages& reference(const MethodPlan& method, StageLog& log);
  void check_effects_of(const MethodPlan& asked, const MethodRun& run, RunRecord& record);

  const ComparePlan& plan_;
  Session& session_;
  std::list<ReferenceImages> made_;  // a list: references handed out stay valid
};

// The table printed at the end, which light paths were compared, what was left out, failures and warnings.
std::string summary_text(const std::vector<RunRecord>& records);

}  // namespace relight
