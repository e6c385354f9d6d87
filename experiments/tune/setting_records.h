// The records of a search: what was measured before is not measured again, whether a minute ago or by a
// search that was killed.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "common/run/run_record.h"
#include "experiments/compare/compare.h"
#include "experiments/tune/tune_plan.h"

namespace relight {

class SettingRecords {
 public:
  // Reads OUT/records.jsonl if it is there.
  explicit SettingRecords(const TunePlan& plan);

  // The record of this setting on the session's scene, view and lighting: an earlier one, or measured now and
  // appended.
  const RunRecord& of(const MethodPlan& method, Session& session, Comparison& comparison);
  int64_t measured_now() const { return measured_now_; }

 private:
  const RunRecord* find(const MethodPlan& method, const Session& session) const;

  const TunePlan& plan_;
  std::filesystem::path file_;
  std::vector<std::unique_ptr<RunRecord>> records_;
  int64_t measured_now_ = 0;
};

}  // namespace relight
