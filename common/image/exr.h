// OpenEXR in and out (32-bit float, ZIP), PNG out for looking. Written to a temporary file, then renamed.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/image/image.h"

namespace relight {

// metadata becomes string attributes of the header. Throws Error naming the file.
void write_exr(const std::filesystem::path& file, const Image& image,
               const std::map<std::string, std::string>& metadata = {});
// Several images of one size as the layers of one file: channels NAME.R, NAME.G, NAME.B. Throws Error naming
// the file; std::logic_error if sizes differ or there is no layer.
struct NamedImage {
  std::string name;
  const Image* image;
};
void write_exr_layers(const std::filesystem::path& file, const std::vector<NamedImage>& layers,
                      const std::map<std::string, std::string>& metadata = {});
// The layer `name` of such a file. Throws Error naming the file and its layers.
Image read_exr_layer(const std::filesystem::path& file, const std::string& name);
// The first image's first three channels, or one grey channel for all three. Throws Error naming the file.
Image read_exr(const std::filesystem::path& file);
// A string attribute of the header; empty if it has none of that name. Throws Error naming the file.
std::string read_exr_attribute(const std::filesystem::path& file, const std::string& name);
// sRGB-encoded 8-bit PNG of image x exposure, clamped to [0,1]; pixels with NaN or infinity are magenta.
void write_png(const std::filesystem::path& file, const Image& image, float exposure);

}  // namespace relight
