#include "experiments/report/data_uri.h"

#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <unistd.h>

#include <glm/gtc/packing.hpp>
#include <glm/gtc/type_precision.hpp>

#include "common/image/exr.h"
#include "common/image/write_encoded.h"

namespace relight::report {

std::string base64(const std::vector<unsigned char>& bytes) {
  constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = bytes.size() - i;
    const unsigned group = static_cast<unsigned>(bytes[i]) << 16 |
                           (left > 1 ? static_cast<unsigned>(bytes[i + 1]) << 8 : 0u) |
                           (left > 2 ? static_cast<unsigned>(bytes[i + 2]) : 0u);
    text += alphabet[group >> 18 & 63u];
    text += alphabet[group >> 12 & 63u];
    text += left > 1 ? alphabet[group >> 6 & 63u] : '=';
    text += left > 2 ? alphabet[group & 63u] : '=';
  }
  return text;
}

namespace {

// Named like the files that remove_leftovers() takes away if the program is killed here.
std::filesystem::path scratch_file(const std::filesystem::path& folder) {
  return folder / fmt::format(".relight-page-image.{}-0.tmp.png", getpid());
}

// Of the file, which is removed.
std::string uri_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(in),
                                         std::istreambuf_iterator<char>()};
  in.close();
  std::filesystem::remove(file);
  return "data:image/png;base64," + base64(bytes);
}

}  // namespace

std::string png_data_uri(const Image& image, float exposure, const std::filesystem::path& scratch) {
  const std::filesystem::path file = scratch_file(scratch);
  write_png(file, image, exposure);
  return uri_of(file);
}

std::string half_planes_uri(const Image& image, const std::filesystem::path& scratch) {
  const size_t n = image.pixels.size();
  std::vector<glm::u8vec3> bytes(2 * n);
  for (size_t i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) {
      const uint16_t half = glm::packHalf1x16(image.pixels[i][c]);
      bytes[i][c] = static_cast<uint8_t>(half >> 8);
      bytes[n + i][c] = static_cast<uint8_t>(half & 255u);
    }
  OIIO::ImageSpec spec(image.width, 2 * image.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");  // what a canvas has: the browser changes nothing
  const std::filesystem::path file = scratch_file(scratch);
  write_encoded(file, spec, bytes.data());
  return uri_of(file);
}

}  // namespace relight::report
