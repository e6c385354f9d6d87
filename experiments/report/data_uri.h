// Pictures inside the page, so that it works from a file without a network.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "common/image/image.h"

namespace relight::report {

// RFC 4648, with padding.
std::string base64(const std::vector<unsigned char>& bytes);

// "data:image/png;base64,..." of image x exposure in sRGB. `scratch` is a folder for a temporary file.
std::string png_data_uri(const Image& image, float exposure, const std::filesystem::path& scratch);

// The same of the values themselves as 16-bit floats, without loss: a PNG of twice the height, the high bytes
// above, the low bytes below. Values beyond 65,504 become infinity.
std::string half_planes_uri(const Image& image, const std::filesystem::path& scratch);

}  // namespace relight::report
