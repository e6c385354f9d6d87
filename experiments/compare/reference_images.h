// The path-traced reference of a comparison, kept in the artefact cache: a sweep of many method settings
// under one lighting costs one reference.
#pragma once

#include <string>

#include "experiments/session/session.h"
#include "reference/path_tracer.h"

namespace relight {

// Raise it whenever the path tracer's estimate changes for the same settings.
inline constexpr int reference_version = 2;

struct ReferenceImages {
  PathTracerSettings settings;
  PathTracerResult result;
  bool from_cache = false;
  double seconds = 0.0;               // wall time of this invocation: tracing or loading
  std::vector<std::string> warnings;  // of its tracing, kept in the cache with it
};

// Everything the picture depends on but for the number of samples, in words and exact decimal numbers.
std::string picture_key(const Session& session, const PathTracerSettings& settings);
// The same with samples and batches.
std::string reference_key(const Session& session, const PathTracerSettings& settings);

// Traces or loads. A time limit makes the result depend on the machine's load, so such results are not
// stored.
ReferenceImages reference_images(Session& session, const PathTracerSettings& settings, StageLog& log);

// Do both sets name the same light paths?
bool same_paths(const LightPaths& a, const LightPaths& b);

}  // namespace relight
