// `relight references`: what is stored, whether the path tracer still agrees, and how to store anew.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace relight {

struct ReferencesOptions {
  std::string folder = "reference/images";
  std::vector<std::string> names;  // empty: all
  int samples_per_batch = 4;       // of `check`, a pixel
  uint64_t seed = 1;               // of `check`
  bool quiet = false;
};

// Each returns text to print and sets `good` to false if something stored is missing, stale or disagrees.
// Unknown names throw UsageError listing the valid ones.
std::string list_references(const ReferencesOptions& options, bool& good);
std::string check_references(const ReferencesOptions& options, bool& good);
std::string update_references(const ReferencesOptions& options, bool& good);

}  // namespace relight
