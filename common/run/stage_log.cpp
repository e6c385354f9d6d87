#include "common/run/stage_log.h"

#include <algorithm>

namespace relight {

void StageLog::add_seconds(const std::string& stage, double seconds) {
  const auto same_name = [&](const auto& entry) { return entry.first == stage; };
  const auto found = std::find_if(stages_.begin(), stages_.end(), same_name);
  if (found == stages_.end())
    stages_.emplace_back(stage, seconds);
  else
    found->second += seconds;
}

void StageLog::add(const StageLog& other) {
  for (const auto& [stage, seconds] : other.stages_) add_seconds(stage, seconds);
  for (const auto& [counter, n] : other.counters_) count(counter, n);
  for (const auto& [artefact, n] : other.bytes_) bytes(artefact, n);
  warnings_.insert(warnings_.end(), other.warnings_.begin(), other.warnings_.end());
  restored_s_ += other.restored_s_;
}

double StageLog::total_seconds() const {
  double sum = 0.0;
  for (const auto& [stage, seconds] : stages_) sum += seconds;
  return sum;
}

}  // namespace relight
