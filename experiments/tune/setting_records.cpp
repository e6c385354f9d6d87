#include "experiments/tune/setting_records.h"

#include <fmt/format.h>

namespace relight {

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
        record.view_hash == view_hash(session.buffer().view) &&
        record.lighting_hash == lighting_hash(session.lighting()) && record.seed == plan_.session.seed &&
        record.failed_stages.empty() && record.reference &&
        record.reference->samples >= plan_.reference_samples)
      return &record;
  }
  return nullptr;
}

const RunRecord& SettingRecords::of(const MethodPlan& method, Session& session, Comparison& comparison) {
  if (const RunRecord* found = find(method, session)) return *found;
  RunRecord record = comparison.measure(method);
  ++measured_now_;
  append_record(file_, record);
  records_.push_back(std::make_unique<RunRecord>(std::move(record)));
  return *records_.back();
}

}  // namespace relight
