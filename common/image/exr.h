// OpenEXR in and out (32-bit float, ZIP), PNG out for looking. Written to a temporary file, then renamed.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "common/image/image.h"

namespace relight {

// metadata becomes string attributes of the header. Throws Error naming the file.
void write_exr(const std::filesystem::path& file, const Image& image,
               const std::map<std::string, std::string>& metadata = {});
// The first image's first three channels, or one grey channel for all three. Throws Error naming the file.
Image read_exr(const std::filesystem::path& file);
// sRGB-encoded 8-bit PNG of image x exposure, clamped to [0,1]; pixels with NaN or infinity are magenta.
void write_png(const std::filesystem::path& file, const Image& image, float exposure);

}  // namespace relight
