// Embree alone on the rays of a log, by as many threads as traced them: the limit that `relight bench`
// reports against.
#pragma once

#include <vector>

#include "common/tracing/ray_log.h"
#include "common/tracing/ray_tracer.h"

namespace relight {

class Replay {
 public:
  // Both must outlive the replay.
  Replay(const RayTracer& tracer, const RayLog& log);
  void run();
  // Of the last run.
  RayCounts counts() const;

 private:
  const RayTracer& tracer_;
  std::vector<const RayLog::Thread*> threads_;
  std::vector<RayCounts> counts_;
};

}  // namespace relight
