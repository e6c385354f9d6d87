// What `render`, `reference` and `compare` have in common, as typed on the command line.
#pragma once

#include <cstdint>
#include <string>

namespace relight {

struct SessionOptions {
  std::string scene;             // built-in name with parameters, or a file
  std::string lights;            // preset or file, "@SECONDS" if it moves; empty: the only or default preset
  std::string view = "640x480";  // pixels, "NAME:" before them for a view of the scene
  std::string gpu = "osmesa";    // osmesa, egl or auto
  uint64_t seed = 1;
  int threads = 0;  // 0: all cores
  bool no_cache = false;
  std::string cache_folder;     // empty: ArtefactCache::default_folder()
  bool quiet = false;           // no progress on standard error
  double time = 0.0;            // of an animated lighting that is named without one [s]
  bool shared_machine = false;  // other runs are at work at the same time: goes into the records
};

}  // namespace relight
