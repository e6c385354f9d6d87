// Writes a scene for Mitsuba 3, so that an independent renderer can check the reference (docs/mitsuba.md).
#pragma once

#include <string>
#include <vector>

namespace relight {

struct MitsubaExportOptions {
  std::string scene;   // built-in name with parameters, or a file
  std::string lights;  // as SessionOptions has it
  std::string view = "640x480";
  int max_bounces = 8;  // of indirect light
  std::string out;      // folder
};

// Fills the folder with scene.xml, meshes/, textures/ and render.py; the same input gives the same bytes.
// scene.xml is written last, each file at once or not at all. Returns the summary to print, warnings
// included. Throws UsageError for options that are wrong, Error naming the file for one that can't be read or
// written.
std::string export_mitsuba(const MitsubaExportOptions& options);

}  // namespace relight
