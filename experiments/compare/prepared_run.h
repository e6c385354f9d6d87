// A method on a session, step by step: prepared and relit once to warm up, then timed as often as somebody
// asks for it. Several of them can be timed by turns, so that a machine that slows down slows all of them.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "experiments/compare/run_method.h"

namespace relight {

class PreparedRun {
 public:
  // Prepares and warms up. What the method throws, and images of the wrong size, become the run's failure;
  // then nothing is left to do. The session and the site outlive this.
  PreparedRun(const MethodPlan& plan, Session& session, const MethodSite& site, int repeats);
  PreparedRun(const PreparedRun&) = delete;
  PreparedRun& operator=(const PreparedRun&) = delete;

  const MethodPlan& plan() const { return plan_; }
  bool failed() const { return !run_.failure.empty(); }
  int repeats() const { return repeats_; }  // that the warm-up's duration allows
  int64_t bytes() const;  // kept in memory: prepared data as the method logs them, and the images
  // One relight against the clock, or one to warm up again.
  void relight_timed();
  void relight_untimed();
  // Frees the prepared data.
  MethodRun finish();

 private:
  void attempt(const char* phase, const std::function<void()>& work);
  double relight_once(StageLog& log);

  const MethodPlan plan_;
  Session& session_;
  const MethodSite site_;
  MethodRun run_;
  const PrepareContext context_;
  std::unique_ptr<Prepared> prepared_;
  std::vector<StageLog> logs_;  // of the timed relights
  int repeats_ = 0;
  double used_s_ = 0.0;  // of the site's time limit
};

// Every run's repeats, in three rounds: in each, every run in turn does a third of its repeats, after one
// relight that is not timed (another run's data fill the processor's caches). Every second round goes
// backwards, so that none always follows the same. One run alone does its repeats without further ado.
void time_in_rounds(const std::vector<PreparedRun*>& runs);

}  // namespace relight
