// Multi-layer OpenEXR files.
#include <algorithm>
#include <memory>
#include <stdexcept>

#include <OpenImageIO/imageio.h>

#include "common/image/exr.h"
#include "common/image/write_encoded.h"
#include "common/run/error.h"

namespace relight {

void write_exr_layers(const std::filesystem::path& file, const std::vector<NamedImage>& layers,
                      const std::map<std::string, std::string>& metadata) {
  if (layers.empty()) throw std::logic_error("write_exr_layers: no layer");
  const Image& first = *layers[0].image;
  const size_t channels = 3 * layers.size();
  OIIO::ImageSpec spec(first.width, first.height, static_cast<int>(channels), OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  spec.channelnames.clear();
  std::vector<float> values(first.pixels.size() * channels);
  for (size_t l = 0; l < layers.size(); ++l) {
    const Image& image = *layers[l].image;
    if (image.width != first.width || image.height != first.height)
      throw std::logic_error("write_exr_layers: layers differ in size");
    for (size_t c = 0; c < 3; ++c) {
      spec.channelnames.push_back(layers[l].name + "." + "RGB"[c]);
      for (size_t i = 0; i < image.pixels.size(); ++i)
        values[i * channels + 3 * l + c] = image.pixels[i][static_cast<int>(c)];
    }
  }
  write_encoded(file, spec, values.data());
}

Image read_exr_layer(const std::filesystem::path& file, const std::string& name) {
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) fail("cannot read '{}': {}", file.string(), OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  const auto& names = spec.channelnames;
  // Channels are sorted by name in the file: blue comes first.
  int channel[3];
  for (int c = 0; c < 3; ++c) {
    const auto found = std::find(names.begin(), names.end(), name + "." + "RGB"[c]);
    if (found == names.end()) {
      std::string valid;
      for (const std::string& n : names)
        if (n.ends_with(".R")) valid += " " + n.substr(0, n.size() - 2);
      fail("'{}' has no layer '{}'; it has:{}", file.string(), name, valid);
    }
    channel[c] = static_cast<int>(found - names.begin());
  }
  const auto channels = static_cast<size_t>(spec.nchannels);
  Image image(spec.width, spec.height);
  std::vector<float> values(image.pixels.size() * channels);
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    fail("cannot read '{}': {}", file.string(), in->geterror());
  for (size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) image.pixels[i][c] = values[i * channels + static_cast<size_t>(channel[c])];
  return image;
}

}  // namespace relight
