// Choosing a few pixels of a view, and the small picture that they make.
#include "common/sampling/pixel_subset.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "common/run/error.h"
#include "common/tracing/ray_tracer.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

// Each pixel's value tells where it is.
Image numbered(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.at(x, y) = glm::vec3(x, y, 1.0f);
  return image;
}

// Red if a tile is chosen twice or blocks are cut at the rim in another way than the mask (tried: without the
// check for blocks that were chosen before).
TEST(PixelSubset, HoldsAsManyPixelsAsItsMask) {
  for (const glm::ivec2 block : {glm::ivec2(4), glm::ivec2(16, 8)}) {
    const PixelSubset subset = choose_pixels(61, 45, 2000, block, 1);
    const std::vector<uint8_t> mask = pixel_mask(subset);
    EXPECT_EQ(std::count(mask.begin(), mask.end(), 1), subset.pixels());
    EXPECT_GE(subset.pixels(), 2000);
    EXPECT_LT(subset.pixels(), 2000 + block.x * block.y);
    ASSERT_EQ(subset.block.size(), subset.tiles.size());
    EXPECT_TRUE(std::is_sorted(subset.block.begin(), subset.block.end()));
  }
}

TEST(PixelSubset, IsTheWholeViewIfThatManyPixelsAreAskedFor) {
  const PixelSubset subset = choose_pixels(61, 45, 1 << 20, glm::ivec2(4), 1);
  EXPECT_EQ(subset.pixels(), 61 * 45);
}

// A quarter of the pixels: each quarter of the view has its share within a fifth. Red if x and y of the
// sequence are mixed up or the points are not spread (tried: x taken
// for both, which never ends).
TEST(PixelSubset, IsSpreadOverTheView) {
  const PixelSubset subset = choose_pixels(128, 64, 2048, glm::ivec2(4), 5);
  int count[4] = {};
  for (const glm::ivec2& tile : subset.tiles) ++count[(tile.x >= 64) + 2 * (tile.y >= 32)];
  for (const int c : count) EXPECT_NEAR(c, 32, 6);
}

TEST(PixelSubset, DependsOnItsSeedOnly) {
  const auto tiles = [](uint64_t seed) { return choose_pixels(64, 48, 256, glm::ivec2(4), seed).tiles; };
  EXPECT_EQ(tiles(3), tiles(3));
  EXPECT_NE(tiles(3), tiles(4));
}

// Red if tiles change places or rows and columns are swapped.
TEST(PixelSubset, CompactPictureHoldsTheTilesSideBySide) {
  const PixelSubset subset = choose_pixels(30, 22, 200, glm::ivec2(8, 4), 2);
  const Image small = compact(numbered(30, 22), subset);
  ASSERT_EQ(small.width, 4 * static_cast<int>(subset.tiles.size()));
  ASSERT_EQ(small.height, 4);
  for (size_t t = 0; t < subset.tiles.size(); ++t)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {
        const glm::ivec2 at = subset.tiles[t] + glm::ivec2(x, y);
        const bool inside = at.x < 30 && at.y < 22;
        EXPECT_EQ(small.at(4 * static_cast<int>(t) + x, y), inside ? glm::vec3(at, 1.0f) : glm::vec3(0.0f));
      }
}

// Red if a sub-sample is taken for another one.
TEST(PixelSubset, CompactBufferKeepsSamplesAndEdges) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  const DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 30, 22});
  const PixelSubset subset = choose_pixels(30, 22, 200, glm::ivec2(4), 2);
  const DeepFrameBuffer small = compact(buffer, subset);
  for (size_t t = 0; t < subset.tiles.size(); ++t) {
    const auto [x, y] = std::pair(subset.tiles[t].x, subset.tiles[t].y);
    if (x + 4 > 30 || y + 4 > 22) continue;
    const size_t small_width = 4 * subset.tiles.size();
    for (size_t sub = 0; sub < 64; ++sub) {
      const size_t sx = sub % 8, sy = sub / 8;
      EXPECT_EQ(
          small.direct[sy * 2 * small_width + 8 * t + sx].position,
          buffer.direct[(2 * static_cast<size_t>(y) + sy) * 60 + 2 * static_cast<size_t>(x) + sx].position);
    }
    EXPECT_EQ(small.edge[2 * small_width + 4 * t + 3],
              buffer.edge[(static_cast<size_t>(y) + 2) * 30 + static_cast<size_t>(x) + 3]);
    EXPECT_EQ(small.indirect[2 * small_width + 4 * t + 3].position,
              buffer.indirect[(static_cast<size_t>(y) + 2) * 30 + static_cast<size_t>(x) + 3].position);
  }
}

TEST(PixelSubset, OnlySubSamplesOfWantedPixelsStayValid) {
  const Scene scene = tiny::room();
  const RayTracer tracer(scene);
  DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 12, 8});
  EXPECT_EQ(wanted_direct_samples(buffer).size(), buffer.direct.size());
  buffer.wanted.assign(96, 0);
  buffer.wanted[5 * 12 + 7] = 1;
  const std::vector<SurfaceSample> samples = wanted_direct_samples(buffer);
  for (size_t i = 0; i < samples.size(); ++i) {
    const bool wanted = i / 24 / 2 == 5 && i % 24 / 2 == 7;
    EXPECT_EQ(samples[i].valid, wanted && buffer.direct[i].valid) << i;
  }
}

TEST(PixelSubset, RefusesSizesOutOfRange) {
  EXPECT_THROW(choose_pixels(0, 4, 1, glm::ivec2(4), 1), Error);
  EXPECT_THROW(choose_pixels(4, 4, 0, glm::ivec2(4), 1), Error);
  EXPECT_THROW(choose_pixels(4, 4, 1, glm::ivec2(4, 6), 1), Error);
}

}  // namespace
}  // namespace relight
