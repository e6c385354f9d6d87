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

double StageLog::total_seconds() const {
  double sum = 0.0;
  for (const auto& [stage, seconds] : stages_) sum += seconds;
  return sum;
}

}  // namespace relight
