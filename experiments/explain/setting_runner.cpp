#include "experiments/explain/setting_runner.h"
#include "common/finite.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/run/error.h"
#include "experiments/compare/run_method.h"

namespace relight {
namespace {

DeepFrameBuffer with_wanted(const DeepFrameBuffer& buffer, const PixelSubset& subset) {
  DeepFrameBuffer out = buffer;
  out.wanted = pixel_mask(subset);
  return out;
}

void require_finite(const Image& image, const std::string& label, const char* which) {
  const auto bad = std::find_if_not(image.pixels.begin(), image.pixels.end(), finite);
  if (bad != image.pixels.end())
    fail("explain-error, {}: the {} image has a pixel that is not finite, number {} of the subset", label,
         which, bad - image.pixels.begin());
}

}  // namespace

SettingRunner::SettingRunner(Session& session, const PixelSubset& subset, int repeats,
                             const std::vector<MethodPlan>& planned)
    : session_(session), subset_(subset), repeats_(repeats), buffer_(with_wanted(session.buffer(), subset)) {
  std::map<std::map<std::string, std::string>, const MethodPlan*> different;
  for (const MethodPlan& method : planned) different.emplace(method.knobs.all(), &method);
  settings_ = different.size();
  for (const auto& [knobs, method] : different) ++to_come_[method->knobs.precompute_key()];
}

double SettingRunner::warm_up(const MethodPlan& method) {
  if (!session_.options().quiet) fmt::print(stderr, "what all settings share\n");
  const auto start = std::chrono::steady_clock::now();
  ArtefactCache nothing({}, false);
  const MethodRun run = run_method(method, session_, {buffer_, nothing, &parts_}, 1);
  if (!run.failure.empty()) fail("explain-error, as asked: {}", run.failure);
  start_ = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(start_ - start).count();
}

SettingResult SettingRunner::run(const std::string& label, const MethodPlan& method) {
  const auto known = results_.find(method.knobs.all());
  if (known != results_.end()) return known->second;
  tell(label);
  const bool shared =
      precompute_s_.contains(method.knobs.precompute_key()) || --to_come_[method.knobs.precompute_key()] > 0;
  ArtefactCache nothing({}, false);
  const MethodRun run =
      run_method(method, session_, {buffer_, shared ? artefacts_ : nothing, &parts_}, repeats_);
  if (!run.failure.empty()) fail("explain-error, {}: {}", label, run.failure);
  keep_warnings(run.precompute);
  keep_warnings(run.relight);
  // Later settings with this key may have found the data in memory.
  const double precompute_s =
      precompute_s_.emplace(method.knobs.precompute_key(), run.precompute_s).first->second;
  const RelightTime relight_ms = summarise_times(run.relight_ms);
  records_.push_back(
      {label, method.knobs.all(), precompute_s, relight_ms, run.precompute.stages(), run.relight.stages()});
  SettingResult result{{compact(run.relit.total, subset_), compact(run.relit.indirect, subset_)},
                       precompute_s,
                       relight_ms.median};
  require_finite(result.picture.total, label, "total");
  require_finite(result.picture.indirect, label, "indirect");
  return results_.emplace(method.knobs.all(), std::move(result)).first->second;
}

void SettingRunner::tell(const std::string& label) const {
  if (session_.options().quiet) return;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const auto done = static_cast<int64_t>(records_.size());
  fmt::print(stderr, "{}: {}\n", format_progress("settings", done, static_cast<int64_t>(settings_), elapsed),
             label);
}

void SettingRunner::keep_warnings(const StageLog& log) {
  for (const std::string& warning : log.warnings())
    if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
      warnings_.push_back(warning);
}

}  // namespace relight
