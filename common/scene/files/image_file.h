// Textures and environment maps from image files, through OpenImageIO.
#pragma once

#include <filesystem>
#include <span>

#include "common/scene/scene.h"

namespace relight {

// Linear RGB, row 0 at the bottom. Integer formats are taken as sRGB-encoded, float and half formats as
// linear; grey images are spread over the three channels, alpha is ignored. Throws Error naming the file and
// the reason.
Texture load_texture(const std::filesystem::path& file);
// The same from the bytes of an image file held in memory (textures embedded in GLB files); `name` is for
// messages.
Texture load_texture_from_memory(std::span<const unsigned char> bytes, const std::string& name);

// The slide of a projector; integer formats are taken as sRGB-encoded. Throws Error naming the file if it
// can't be read, is larger than 2^24 pixels or holds a negative or non-finite value.
Slide load_slide(const std::filesystem::path& file);

// Fills width, height and texels (row 0 on top) of a latitude-longitude map. Throws Error naming the file if
// it can't be read or holds a negative or non-finite value.
void load_environment_map(const std::filesystem::path& file, Environment& environment);

}  // namespace relight
