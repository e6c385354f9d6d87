// `relight bench`: how fast the path tracer is, against what Embree alone does with the same rays.
#pragma once

#include <string>

#include "experiments/session/options.h"

namespace relight {

struct BenchOptions {
  SessionOptions session;
  std::string bounces = "0..4";
  std::string estimator = "light_vertex";
  int samples = 4;  // paths a pixel
  int repeats = 5;  // of which the medians are reported
};

// Renders the scene `repeats` times, each time followed by Embree alone on the same rays in the same order by
// the same number of threads, so that drift of the machine meets both. Returns a table: rays by kind,
// Mrays/s of both, the share, and where the rest of the time goes as far as it can be told. Throws
// UsageError.
std::string run_bench(const BenchOptions& options);

}  // namespace relight
