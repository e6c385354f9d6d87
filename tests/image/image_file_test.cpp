#include <cmath>
#include <fstream>
#include <limits>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "tests/run/error_message.h"
#include "tests/run/full_disk.h"
#include "tests/run/temporary_folder.h"

namespace relight {
namespace {

Image example_image() {
  Image image(3, 2);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = glm::vec3(static_cast<float>(i) + 1.0f / 3.0f, -0.1f, 1e-30f * static_cast<float>(i));
  image.pixels[5].x = std::numeric_limits<float>::infinity();
  return image;
}

// Bug: half floats (0.333 loses digits, 1e-30 becomes 0), rows upside down, channels swapped.
TEST(ImageFile, ExrKeepsEveryBit) {
  const TemporaryFolder folder;
  const Image image = example_image();
  write_exr(folder.path() / "new" / "a.exr", image);
  const Image read = read_exr(folder.path() / "new" / "a.exr");
  ASSERT_EQ(read.width, 3);
  ASSERT_EQ(read.height, 2);
  EXPECT_EQ(read.pixels, image.pixels);
}

// Bug: metadata dropped.
TEST(ImageFile, ExrCarriesItsMetadata) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.exr";
  write_exr(file, example_image(), {{"relight:scene", "cornell"}});
  const auto in = OIIO::ImageInput::open(file.string());
  ASSERT_TRUE(in);
  EXPECT_EQ(in->spec().get_string_attribute("relight:scene"), "cornell");
  EXPECT_EQ(in->spec().get_string_attribute("compression"), "zip");
}

// Bug: a second result under the same name fails, or leaves a temporary file beside it.
TEST(ImageFile, WritingReplacesTheOldFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.exr";
  write_exr(file, Image(1, 1));
  write_exr(file, example_image());
  EXPECT_EQ(read_exr(file).width, 3);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

// Bug: a full disk leaves half an image under the final or a temporary name, or passes in silence.
TEST(ImageFile, FullDiskIsAnErrorThatLeavesNothingBehind) {
  const TemporaryFolder folder;
  Image noise(200, 200);
  uint32_t state = 1;
  for (auto& pixel : noise.pixels)
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(state = state * 1664525u + 1013904223u);
  for (const char* name : {"a.exr", "a.png"}) {
    const auto write = [&] {
      const FileSizeLimit limit(10'000);
      if (std::string(name) == "a.exr")
        write_exr(folder.path() / name, noise);
      else
        write_png(folder.path() / name, noise, 1e-10f);
    };
    const std::string message = error_message(write);
    EXPECT_NE(message.find(name), std::string::npos) << message;
    EXPECT_TRUE(is_empty(folder.path())) << name;
  }
}

// Bug: a missing or broken file crashes, or gives an empty image.
TEST(ImageFile, ErrorsNameTheFile) {
  const TemporaryFolder folder;
  const auto broken = folder.path() / "broken.exr";
  std::ofstream(broken) << "not an image";
  for (const auto& file : {folder.path() / "missing.exr", broken}) {
    const std::string message = error_message([&] { read_exr(file); });
    EXPECT_NE(message.find(file.string()), std::string::npos) << message;
  }
  const std::string message = error_message([&] { write_exr(broken / "a.exr", example_image()); });
  EXPECT_NE(message.find(broken.string()), std::string::npos) << message;
  EXPECT_THROW(write_exr(folder.path() / "empty.exr", Image()), Error);
}

// sRGB: 0.2 is 1.055 * 0.2^(1/2.4) - 0.055 = 0.484529, times 255 = 123.55; 0.001 is 12.92 * 0.001 * 255
// = 3.29. Bug: gamma forgotten, or applied before the exposure; wrap-around above white; NaN shown as black.
TEST(ImageFile, PngIsExposedSrgb) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.png";
  Image image(4, 1);
  image.pixels = {glm::vec3(0.1f, 0.0005f, 0.0f), glm::vec3(100.0f), glm::vec3(-1.0f),
                  glm::vec3(0.5f, std::numeric_limits<float>::quiet_NaN(), 0.5f)};
  write_png(file, image, 2.0f);
  const auto in = OIIO::ImageInput::open(file.string());
  ASSERT_TRUE(in);
  std::vector<uint8_t> bytes(12);
  ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, bytes.data()));
  EXPECT_EQ(bytes, (std::vector<uint8_t>{124, 3, 0, 255, 255, 255, 0, 0, 0, 255, 0, 255}));
}

}  // namespace
}  // namespace relight
