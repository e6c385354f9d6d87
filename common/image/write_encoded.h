// How image files are written: encoded in memory, then as a whole file or not at all.
#pragma once

#include <filesystem>

#include <OpenImageIO/imageio.h>

namespace relight {

// pixels: in the spec's format and layout. Throws Error naming the file.
void write_encoded(const std::filesystem::path& file, const OIIO::ImageSpec& spec, const void* pixels);

}  // namespace relight
