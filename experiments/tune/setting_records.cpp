#include "experiments/tune/setting_records.h"

#include <cmath>

#include <fmt/format.h>

namespace relight {

namespace {

std::string data_key(const RunRecord& record, const MethodPlan& method) {
  return fmt::format("{}\n{}\n{}\n{}\n{}", record.scene_hash, record.view, record.method, record.seed,
                     method.knobs.precompute_key());
}

}  // namespace

SettingRecords::SettingRecords(const TunePlan& plan) : plan_(plan), file_(plan.out / "records.jsonl") {
  if (!std::filesystem::exists(file_)) return;
  RecordFile read = read_records(file_);
  for (const std::string& warning : read.warnings) fmt::print(stderr, "warning: {}\n", warning);
  for (RunRecord& record : read.records) records_.push_back(std::make_unique<RunRecord>(std::move(record)));
}

const RunRecord* SettingRecords::find(const MethodPlan& method, const Session& session) const {
  const std::string hash = fmt::format("{:016x}", session.scene().content_hash);
  for (auto r = records_.rbegin(); r != records_.rend(); ++r) {
    const RunRecord& record = **r;
    if (record.method == method.method->name() && record.knobs == method.knobs.all() &&
        record.scene == plan_.session.scene && record.scene_hash == hash &&
        record.lighting == session.lighting_name() && record.view == plan_.session.view &&
        record.seed == plan_.session.seed && record.failed_stages.empty() && record.reference &&
        record.reference->samples >= plan_.reference_samples)
      return &record;
  }
  return nullptr;
}

bool SettingRecords::time_known(const RunRecord& record, const MethodPlan& method) const {
  return !std::isnan(outcome(record, method).precompute_s);
}

void SettingRecords::keep(RunRecord record, const MethodPlan& method) {
  const double seconds = outcome_of(record, plan_.metric).precompute_s;
  if (!std::isnan(seconds)) precompute_s_.emplace(data_key(record, method), seconds);
  records_.push_back(std::make_unique<RunRecord>(std::move(record)));
}

const RunRecord& SettingRecords::of(const MethodPlan& method, Session& session, Comparison& comparison) {
  const bool time_counts = plan_.bounds.precompute_s || plan_.bounds.minimise == Cost::precompute;
  if (const RunRecord* found = find(method, session)) {
    const double seconds = outcome_of(*found, plan_.metric).precompute_s;
    if (!std::isnan(seconds)) precompute_s_.emplace(data_key(*found, method), seconds);
    if (!time_counts || time_known(*found, method)) return *found;
  }
  RunRecord record = comparison.measure(method, session.cache());
  if (time_counts && record.failed_stages.empty() && !time_known(record, method)) {
    ArtefactCache nothing({}, false);
    record = comparison.measure(method, nothing);
  }
  ++measured_now_;
  append_record(file_, record);
  keep(std::move(record), method);
  return *records_.back();
}

Outcome SettingRecords::outcome(const RunRecord& record, const MethodPlan& method) const {
  Outcome outcome = outcome_of(record, plan_.metric);
  if (!std::isnan(outcome.precompute_s)) return outcome;
  const auto known = precompute_s_.find(data_key(record, method));
  if (known != precompute_s_.end()) outcome.precompute_s = known->second;
  return outcome;
}

}  // namespace relight
