#include "experiments/bench/replay.h"

#include <tbb/parallel_for.h>

namespace relight {

Replay::Replay(const RayTracer& tracer, const RayLog& log) : tracer_(tracer) {
  for (const RayLog::Thread& thread : log.threads) threads_.push_back(&thread);
  counts_.resize(threads_.size());
}

void Replay::run() {
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, threads_.size(), 1),
      [&](const auto& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) counts_[i] = tracer_.replay(*threads_[i]);
      },
      tbb::simple_partitioner());
}

RayCounts Replay::counts() const {
  RayCounts sum;
  for (const RayCounts& c : counts_) {
    sum.nearest += c.nearest;
    sum.occlusion += c.occlusion;
    sum.in_packets += c.in_packets;
  }
  return sum;
}

}  // namespace relight
