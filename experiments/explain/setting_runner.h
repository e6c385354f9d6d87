// Runs one method under many settings on the same few pixels of a session's view.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/run/run_record.h"
#include "common/sampling/pixel_subset.h"
#include "experiments/compare/plan.h"
#include "experiments/explain/waterfall.h"
#include "experiments/session/session.h"

namespace relight {

// What is written down about a setting.
struct SettingRecord {
  std::string label;  // "as asked", "shadows exact", "all exact but shadows"
  std::map<std::string, std::string> knobs;
  double precompute_s = 0.0;  // without keeping data for other settings
  RelightTime relight_ms;
  std::vector<std::pair<std::string, double>> precompute_stages, relight_stages;  // [s]
};

class SettingRunner {
 public:
  // All must outlive this. planned: what run() will be asked for: tells the time left, and whose precomputed
  // data is worth keeping, which may have gigabytes.
  SettingRunner(Session& session, const PixelSubset& subset, int repeats,
                const std::vector<MethodPlan>& planned);

  // Computes what all settings share (PrepareContext::parts) and whatever is made once a process, so that no
  // setting's time holds it. Returns the seconds that it took.
  double warm_up(const MethodPlan& method);

  // A setting that was run before, or one whose precomputed data was just made, is not computed again;
  // settings with equal precompute knobs report the time of the first. Throws Error naming the setting if the
  // method fails or gives a pixel that is not finite.
  SettingResult run(const std::string& label, const MethodPlan& method);

  const std::vector<SettingRecord>& records() const { return records_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void tell(const std::string& label) const;
  void keep_warnings(const StageLog& log);

  Session& session_;
  const PixelSubset& subset_;
  int repeats_;
  size_t settings_;                     // that differ
  std::map<std::string, int> to_come_;  // settings by precompute key
  DeepFrameBuffer buffer_;
  ArtefactCache artefacts_ = ArtefactCache::in_memory(), parts_ = ArtefactCache::in_memory();
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::map<std::string, double> precompute_s_;                           // by precompute key
  std::map<std::map<std::string, std::string>, SettingResult> results_;  // by knobs
  std::vector<SettingRecord> records_;
  std::vector<std::string> warnings_;
};

}  // namespace relight
