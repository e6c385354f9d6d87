// Lights that a search did not see.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"
#include "experiments/session/session.h"

namespace relight {

inline constexpr size_t wanted_verify_lights = 3;

// The other lighting presets of the scene, at most four; if they are fewer than three, lamps in front of the
// view make up for it, written as lighting files into `folder`. Names as `--lights` takes them.
std::vector<std::string> choose_verify_lights(const Session& session, const std::filesystem::path& folder);

// A lighting file with one lamp: even numbers an omni light, odd ones a spot. It hangs in front of a surface
// that the view shows, seen from there, at a tenth to a third of the scene's diagonal; its intensity gives
// the irradiance that the session's lamps give on average. The same seed and number give the same text.
std::string lamp_file_text(const Scene& scene, const RayTracer& tracer, const DeepFrameBuffer& buffer,
                           const LightingState& like, uint64_t seed, uint64_t number);

}  // namespace relight
