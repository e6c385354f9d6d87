// The `--threads` setting: limits oneTBB (and Embree, which builds with it) to a number of threads while it
// lives.
#pragma once

#include <cstddef>

#include <oneapi/tbb/global_control.h>

namespace relight {

class ThreadLimit {
 public:
  // threads >= 1; 0 leaves the default, all cores.
  explicit ThreadLimit(int threads)
      : control_(tbb::global_control::max_allowed_parallelism,
                 threads > 0 ? static_cast<size_t>(threads) : current()) {}
  // Threads that parallel loops may use now.
  static size_t current() {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  }

 private:
  tbb::global_control control_;
};

}  // namespace relight
