// Textures of an exported scene.
#pragma once

#include <filesystem>

#include "common/image/exr.h"

namespace relight::mitsuba {

// EXR with a fixed date in its header, where OpenImageIO would put the time of writing: the same scene gives
// the same bytes.
inline void write_texture(const std::filesystem::path& file, const Image& image) {
  write_exr(file, image, {{"DateTime", "2000:01:01 00:00:00"}});
}

}  // namespace relight::mitsuba
