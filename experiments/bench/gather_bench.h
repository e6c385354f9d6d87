// `relight bench --gather`: how fast direct_to_indirect's final gather is, with the paper's links and with
// every pair of samples, against what Embree alone does with the same packets.
#pragma once

#include <string>

#include "experiments/session/options.h"

namespace relight {

struct GatherBenchOptions {
  SessionOptions session;
  int gather_samples = 65536;
  int tiles = 32;  // of 4x4 pixels, spread over the view; every ray of them is kept in memory
  int repeats = 5;
};

// The gather cloud and hierarchy of the whole view, rows of some of its tiles (visibility, wavelet transform,
// selection of 100 coefficients). Returns a table: rays a view sample, Mrays/s of the gather and of Embree
// alone on the same packets in the same order, the share, and the time that the whole view would take. Embree
// replays the packets thread by thread: where the threads had unequal parts it waits for the larger one, and
// the share in CPU time is the one to read. Throws UsageError.
std::string run_gather_bench(const GatherBenchOptions& options);

}  // namespace relight
