// What `relight render` writes: one image of a relight, as a picture file.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "common/run/method.h"
#include "experiments/render/render.h"

namespace relight {

// Throws UsageError unless --image names an image and --out a file that can be written.
void check_picture_options(const RenderOptions& options);

// .exr: radiance with the metadata; .png: with exposure, sRGB. `image`: direct, indirect or total. Throws
// Error if pixels are not finite; the file is written all the same.
void write_picture(const std::filesystem::path& file, const Relit& relit, const std::string& image,
                   float exposure, const std::map<std::string, std::string>& metadata);

}  // namespace relight
