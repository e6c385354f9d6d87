#include "experiments/run/batch.h"

#include <algorithm>
#include <new>

#include <unistd.h>

#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "experiments/session/output_folder.h"

namespace relight {
namespace {

// A batch that is killed is lost but for what the cache keeps.
constexpr size_t most_runs = 8;

int64_t memory_budget() { return static_cast<int64_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGE_SIZE) / 4; }

std::string session_key(const PlannedRun& run) {
  const SessionOptions& s = run.plan.session;
  return fmt::format("{}\n{}\n{}\n{}", s.scene, s.lights, s.view, s.seed);
}

bool checks_effects(const PlannedRun& run) { return run.plan.effects && run.plan.effects->check; }

bool same_run(const PlannedRun& a, const PlannedRun& b) {
  const MethodPlan &one = a.plan.methods.front(), &other = b.plan.methods.front();
  const auto tolerance = [](const PlannedRun& r) {
    return r.plan.effects ? r.plan.effects->tolerance : -1.0;
  };
  return one.method == other.method && one.knobs.all() == other.knobs.all() && tolerance(a) == tolerance(b);
}

// What is known of a run before it starts.
RunRecord empty_record(const PlannedRun& run) {
  RunRecord record;
  record.scene = run.plan.session.scene, record.lighting = run.plan.session.lights;
  record.view = run.plan.session.view, record.seed = run.plan.session.seed;
  record.scene_hash = run.scene_hash;
  record.view_hash = run.view_hash, record.lighting_hash = run.lighting_hash;
  const MethodPlan& method = run.plan.methods.front();
  record.method = method.method->name(), record.preset = method.preset, record.knobs = method.knobs.all();
  return record;
}

// Errors that concern one run only become a failed record; that nothing can be written concerns all.
template <typename Work>
void or_fail(RunRecord& record, Work work) {
  try {
    work();
  } catch (const OutputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    record.failed_stages.push_back("out of memory");
  } catch (const std::exception& error) {
    record.failed_stages.push_back(error.what());
  }
}

}  // namespace

int64_t Batch::bytes() const {
  int64_t sum = 0;
  for (const Waiting& waiting : waiting_) sum += waiting.started.run ? waiting.started.run->bytes() : 0;
  return sum;
}

bool Batch::takes(const PlannedRun& run, int64_t bytes_of_run) const {
  if (waiting_.empty()) return true;
  if (waiting_.size() >= most_runs || session_key(run) != key_ || checks_effects(run)) return false;
  if (bytes() + bytes_of_run > memory_budget()) return false;
  return std::none_of(waiting_.begin(), waiting_.end(), [&](const Waiting& waiting) {
    return checks_effects(*waiting.run) || same_run(*waiting.run, run);
  });
}

Session& Batch::session_of(const PlannedRun& run) {
  const std::string key = session_key(run);
  if (!session_ || key != key_) {
    references_.clear();
    session_.reset();  // two of them would need the memory of two
    session_ = std::make_unique<Session>(run.plan.session, Session::Gpu::needed);
    key_ = key;
  }
  return *session_;
}

void Batch::add(const PlannedRun& run, size_t place, const std::filesystem::path& images) {
  Waiting waiting{&run, place, images, nullptr, {run.plan.methods.front(), empty_record(run), nullptr}};
  or_fail(waiting.started.record, [&] {
    remove_leftovers(images);
    waiting.comparison = std::make_unique<Comparison>(run.plan, session_of(run), references_);
    waiting.started = waiting.comparison->start(run.plan.methods.front());
  });
  waiting_.push_back(std::move(waiting));
}

RunRecord Batch::finish_one(Waiting& waiting) {
  RunRecord record = waiting.started.record;
  if (!waiting.started.run) return record;
  or_fail(record, [&] { record = waiting.comparison->finish(std::move(waiting.started), waiting.images); });
  return record;
}

void Batch::finish() {
  std::vector<PreparedRun*> timed;
  for (const Waiting& waiting : waiting_)
    if (waiting.started.run && !waiting.started.run->failed()) timed.push_back(waiting.started.run.get());
  time_in_rounds(timed);
  // Handed over one by one: what is written stays if the next one cannot be.
  std::vector<Waiting> waiting = std::move(waiting_);
  waiting_.clear();
  for (Waiting& one : waiting) keep_(one.place, finish_one(one));
}

}  // namespace relight
