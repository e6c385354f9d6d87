// `relight reference`: the path tracer alone, with its light paths, noise and convergence.
#pragma once

#include <string>

#include "experiments/session/options.h"

namespace relight {

struct ReferenceOptions {
  SessionOptions session;
  std::string bounces = "0..8";
  std::string glossy = "all";  // none, eye (visible surface only) or all
  std::string paths;           // pattern of light paths that make up the picture; empty: all
  bool layers = false;         // write each path class
  int class_bounces = 4;       // told apart up to this many bounces
  int samples = 256;           // indirect paths a pixel
  int batch = 8;               // of which so many at a time
  std::string estimator = "light_vertex";
  double time_limit_s = 0.0;    // > 0: stop before the batch that would exceed it
  double target_percent = 0.0;  // > 0: stop at this relative standard error
  double checkpoint_s = 30.0;   // the checkpoint is written after batches that end this much later
  bool restart = false;         // ignore what an earlier run left in `out`
  std::string out;              // folder
};

// Writes direct.exr, indirect.exr, total.exr, variance.exr (of the indirect mean), with `layers` layers.exr
// and layers_variance.exr, convergence.csv, reference.json, and state.relight, from which the next run with
// the same settings goes on (more samples, or after an interruption). Returns a few lines about them. Throws
// UsageError before anything slow starts, Error on samples that were not finite.
std::string run_reference(const ReferenceOptions& options);

}  // namespace relight
