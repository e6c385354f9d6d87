// What is stored in reference/images: the one list of pictures, their light paths and their samples.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/run/light_paths.h"

namespace relight {

struct StoredReference {
  std::string name;    // of its folder
  std::string scene;   // as `--scene` takes it
  std::string lights;  // preset of the scene
  LightPaths paths;
  int samples_per_batch = 0;  // indirect samples a pixel in each of stored_batches renders
};

// Small, so that pictures can live in the repository and be rendered afresh by every test run.
inline constexpr const char* stored_view = "96x72";
// Independent renders of each picture. 32 give variances with 31 degrees of freedom: at the levels of the
// tests (1e-9 a pixel) Student's quantile is then 1.4 times the normal one; with 8 it would be 8 times.
inline constexpr int stored_batches = 32;
inline constexpr uint64_t stored_seed = 2006;

// Sorted as `relight scene list`.
const std::vector<StoredReference>& stored_references();

// The entry called `name`; throws UsageError listing the valid names.
const StoredReference& stored_reference(const std::string& name);

}  // namespace relight
