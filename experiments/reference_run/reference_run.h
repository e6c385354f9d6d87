// `relight reference`: the path tracer alone, with its noise floor.
#pragma once

#include <string>

#include "experiments/session/options.h"

namespace relight {

struct ReferenceOptions {
  SessionOptions session;
  std::string bounces = "1..8";
  std::string glossy = "all";  // none, eye (visible surface only) or all
  int samples = 256;           // indirect paths a pixel
  std::string estimator = "light_vertex";
  double time_limit_s = 0.0;  // > 0: stop before the batch that would exceed it
  std::string out;            // folder
};

// Writes direct.exr, indirect.exr, total.exr, variance.exr (of the indirect mean) and reference.json; returns
// a few lines about them. Throws UsageError before anything slow starts, Error on samples that were not
// finite.
std::string run_reference(const ReferenceOptions& options);

}  // namespace relight
