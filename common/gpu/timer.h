// How long GPU work takes: a GL timer query where the driver counts, else the wall clock around glFinish.
#pragma once

#include <chrono>

#include "common/gpu/object.h"

namespace relight::gpu {

// Waits until everything given to the GPU so far is done.
void finish();

class GpuTimer {
 public:
  // Waits for earlier work, then starts. One timer at a time: GL has one elapsed-time query.
  GpuTimer();
  ~GpuTimer();
  GpuTimer(const GpuTimer&) = delete;
  GpuTimer& operator=(const GpuTimer&) = delete;
  // Ends the measurement, waits for the work and returns seconds; further calls return the same.
  double stop();

 private:
  Object query_;
  bool has_counter_ = false;
  double seconds_ = -1.0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace relight::gpu
