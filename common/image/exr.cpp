#include "common/image/exr.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "common/image/write_encoded.h"
#include "common/run/atomic_file.h"
#include "common/run/error.h"

namespace relight {

namespace {

// NaN and infinity must not pass for black or white when somebody looks at a picture.
constexpr glm::u8vec3 non_finite_colour{255, 0, 255};

void require_pixels(const std::filesystem::path& file, const Image& image) {
  if (image.width < 1 || image.height < 1) fail("cannot write '{}': the image has no pixels", file.string());
}

// IEC 61966-2-1, linear [0,1] to encoded [0,255].
uint8_t encode_srgb(float linear) {
  const float x = std::clamp(linear, 0.0f, 1.0f);
  const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
  return static_cast<uint8_t>(std::lround(255.0f * encoded));
}

glm::u8vec3 encode_pixel(const glm::vec3& linear) {
  if (!std::isfinite(linear.x) || !std::isfinite(linear.y) || !std::isfinite(linear.z))
    return non_finite_colour;
  return {encode_srgb(linear.x), encode_srgb(linear.y), encode_srgb(linear.z)};
}

}  // namespace

// Encodes into memory and writes that: OpenImageIO's PNG writer does not tell of a full disk.
void write_encoded(const std::filesystem::path& file, const OIIO::ImageSpec& spec, const void* pixels) {
  OIIO::Filesystem::IOVecOutput memory;
  const auto out = OIIO::ImageOutput::create(file.string(), &memory);
  if (!out) fail("cannot write '{}': {}", file.string(), OIIO::geterror());
  if (!out->open(file.string(), spec)) fail("cannot write '{}': {}", file.string(), out->geterror());
  const bool written = out->write_image(spec.format, pixels);
  if (!out->close() || !written) fail("cannot write '{}': {}", file.string(), out->geterror());
  const auto& buffer = memory.buffer();
  write_text_atomically(file, {reinterpret_cast<const char*>(buffer.data()), buffer.size()});
}

void write_exr(const std::filesystem::path& file, const Image& image,
               const std::map<std::string, std::string>& metadata) {
  require_pixels(file, image);
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  write_encoded(file, spec, image.pixels.data());
}

std::string read_exr_attribute(const std::filesystem::path& file, const std::string& name) {
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) fail("cannot read '{}': {}", file.string(), OIIO::geterror());
  return in->spec().get_string_attribute(name);
}

Image read_exr(const std::filesystem::path& file) {
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) fail("cannot read '{}': {}", file.string(), OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  const int channels = spec.nchannels;
  if (channels != 1 && channels < 3)
    fail("cannot read '{}': it has {} channels; valid: 1 (grey) or at least 3 (RGB)", file.string(),
         channels);
  const int used = std::min(channels, 3);
  Image image(spec.width, spec.height);
  std::vector<float> values(image.pixels.size() * static_cast<size_t>(used));
  if (!in->read_image(0, 0, 0, used, OIIO::TypeDesc::FLOAT, values.data()))
    fail("cannot read '{}': {}", file.string(), in->geterror());
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] =
        used == 1 ? glm::vec3(values[i]) : glm::vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  return image;
}

void write_png(const std::filesystem::path& file, const Image& image, float exposure) {
  require_pixels(file, image);
  std::vector<glm::u8vec3> encoded(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), encoded.begin(),
                 [&](const glm::vec3& pixel) { return encode_pixel(exposure * pixel); });
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  write_encoded(file, spec, encoded.data());
}

}  // namespace relight
