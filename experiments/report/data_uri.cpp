#include "experiments/report/data_uri.h"

#include <fstream>
#include <iterator>

#include "common/image/exr.h"

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

std::string png_data_uri(const Image& image, float exposure, const std::filesystem::path& scratch) {
  const std::filesystem::path file = scratch / ".relight-page-image.png";
  write_png(file, image, exposure);
  std::ifstream in(file, std::ios::binary);
  const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(in),
                                         std::istreambuf_iterator<char>()};
  in.close();
  std::filesystem::remove(file);
  return "data:image/png;base64," + base64(bytes);
}

}  // namespace relight::report
