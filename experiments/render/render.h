// `relight render`: one method, one lighting, one picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/compare/plan.h"
#include "experiments/method_list.h"
#include "experiments/session/options.h"

namespace relight {

struct RenderOptions {
  SessionOptions session;
  std::string method;
  std::string preset = "paper";       // values of knobs before `settings`
  std::vector<std::string> settings;  // "method.knob=value"
  std::string image = "total";        // direct, indirect or total
  std::string out;                    // file ending in .exr (radiance) or .png (scene's exposure, sRGB)
  double fps = 24.0;                  // of render_frames: frames a second
  EffectOptions effects;              // of render(): planned for the lighting as it stands
  bool resume = false;                // of render_frames: frames that are there already are kept
};

// Renders and writes; returns a few lines about what was done. Throws UsageError before anything slow starts,
// Error if the method fails or the image has pixels that are not finite (the file is written all the same).
std::string render(const RenderOptions& options, const MethodList& methods);

}  // namespace relight
