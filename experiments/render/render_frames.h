// `relight render --frames`: an animated lighting, one prepared method, a picture a frame.
#pragma once

#include "experiments/options/frame_times.h"
#include "experiments/render/render.h"

namespace relight {

// File of a frame: "out/day.png" -> "out/day_0007.png".
std::filesystem::path frame_file(const std::filesystem::path& out, int number);

// Prepares once, then relights and writes frame by frame, each under a temporary name first. What the frames
// were made of stands in "out/day_frames.txt"; with options.resume, frames that exist are kept if it says the
// same, and Error is thrown if not. Returns a few lines about what was done. Throws as render() does.
std::string render_frames(const RenderOptions& options, const std::vector<Frame>& frames,
                          const MethodList& methods);

}  // namespace relight
