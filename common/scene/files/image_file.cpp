#include "common/scene/files/image_file.h"

#include <cmath>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "common/run/error.h"
#include "common/scene/content_hash.h"
#include "common/scene/files/material_conversion.h"

namespace relight {

namespace {

struct Pixels {
  int width = 0, height = 0;
  bool encoded = false;         // integer format, taken as sRGB
  std::vector<glm::vec3> rows;  // top row first
};

Pixels read_pixels(OIIO::ImageInput& input, const std::string& name) {
  const OIIO::ImageSpec spec = input.spec();
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels < 1)
    fail("{}: not a flat image ({} x {} x {}, {} channels)", name, spec.width, spec.height, spec.depth,
         spec.nchannels);
  Pixels pixels;
  pixels.width = spec.width;
  pixels.height = spec.height;
  pixels.encoded = !spec.format.is_floating_point();
  const int channels = std::min(spec.nchannels, 4);
  const size_t count = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
  std::vector<float> values(count * static_cast<size_t>(channels));
  if (!input.read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data()))
    fail("{}: {}", name, input.geterror());
  const bool grey = channels < 3;
  pixels.rows.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const float* v = &values[i * static_cast<size_t>(channels)];
    pixels.rows[i] = grey ? glm::vec3(v[0]) : glm::vec3(v[0], v[1], v[2]);
  }
  return pixels;
}

void require_light(const Pixels& pixels, const std::string& name) {
  for (size_t i = 0; i < pixels.rows.size(); ++i) {
    const glm::vec3& c = pixels.rows[i];
    if (c.x >= 0.0f && c.y >= 0.0f && c.z >= 0.0f && std::isfinite(c.x + c.y + c.z)) continue;
    fail("{}: pixel ({}, {}) is ({}, {}, {}); valid: finite values >= 0", name,
         i % static_cast<size_t>(pixels.width), i / static_cast<size_t>(pixels.width), c.x, c.y, c.z);
  }
}

Texture to_texture(Pixels pixels, const std::string& name) {
  require_light(pixels, name);
  Texture texture;
  texture.file = name;
  texture.width = pixels.width;
  texture.height = pixels.height;
  texture.texels.reserve(pixels.rows.size());
  const auto width = static_cast<ptrdiff_t>(pixels.width);
  for (ptrdiff_t y = pixels.height - 1; y >= 0; --y)
    texture.texels.insert(texture.texels.end(), pixels.rows.begin() + y * width,
                          pixels.rows.begin() + (y + 1) * width);
  if (pixels.encoded)
    for (glm::vec3& texel : texture.texels) texel = srgb_to_linear(texel);
  return texture;
}

Pixels open_and_read(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) fail("{}: no such image file", file.string());
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) fail("{}: {}", file.string(), OIIO::geterror());
  return read_pixels(*input, file.string());
}

}  // namespace

Texture load_texture(const std::filesystem::path& file) {
  return to_texture(open_and_read(file), file.string());
}

Texture load_texture_from_memory(std::span<const unsigned char> bytes, const std::string& name) {
  OIIO::Filesystem::IOMemReader reader(const_cast<unsigned char*>(bytes.data()), bytes.size());
  const bool jpeg = bytes.size() > 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
  const auto input = OIIO::ImageInput::open(jpeg ? "embedded.jpg" : "embedded.png", nullptr, &reader);
  if (!input) fail("{}: {}", name, OIIO::geterror());
  return to_texture(read_pixels(*input, name), name);
}

Slide load_slide(const std::filesystem::path& file) {
  Pixels pixels = open_and_read(file);
  require_light(pixels, file.string());
  // Shaders find a texel by a float.
  constexpr size_t most_pixels = size_t{1} << 24;
  if (pixels.rows.size() > most_pixels)
    fail("{}: {} x {} pixels; a slide may have {}", file.string(), pixels.width, pixels.height, most_pixels);
  Slide slide;
  slide.file = file.string();
  slide.width = pixels.width;
  slide.height = pixels.height;
  slide.texels.clear();
  for (const glm::vec3& c : pixels.rows)
    slide.texels.emplace_back(pixels.encoded ? srgb_to_linear(c) : c, 1.0f);
  ContentHash hash;
  hash.add(slide.width);
  hash.add(slide.height);
  hash.add(slide.texels);
  slide.content_hash = hash.value();
  return slide;
}

void load_environment_map(const std::filesystem::path& file, Environment& environment) {
  Pixels pixels = open_and_read(file);
  require_light(pixels, file.string());
  if (pixels.encoded)
    for (glm::vec3& texel : pixels.rows) texel = srgb_to_linear(texel);
  environment.file = file.string();
  environment.width = pixels.width;
  environment.height = pixels.height;
  environment.texels = std::move(pixels.rows);
}

}  // namespace relight
