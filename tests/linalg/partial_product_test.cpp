// The product of some pixels' rows, added onto a whole picture.
#include <gtest/gtest.h>

#include "common/gpu/context.h"
#include "common/linalg/partial_product.h"
#include "common/run/error.h"
#include "common/sampling/random.h"
#include "tests/linalg/product_check.h"

namespace relight {
namespace {

constexpr PictureShape picture{83, 45};

// Pixels in clumps and alone, the corners among them; a row of up to 12 entries each, some empty.
struct Problem {
  std::vector<uint32_t> pixels;
  SparseRows rows;
  std::vector<glm::vec3> scale;

  Problem() {
    const auto count = static_cast<uint32_t>(picture.width * picture.height);
    rows.columns = 256, rows.row_start = {0};
    for (uint32_t p = 0; p < count; ++p) {
      const bool clump = p % 83 > 30 && p % 83 < 50 && p / 83 > 10 && p / 83 < 30;
      if (!clump && p != 0 && p != count - 1 && random_bits(1, 2, p, 0) % 40 != 0) continue;
      pixels.push_back(p);
      for (uint32_t c = 0; c < 256; ++c)
        if (p % 7 != 3 && random_bits(1, 3, p, c) % 32 == 0)
          rows.entries.push_back({c, random_float(1, 4, p, c)});
      rows.row_start.push_back(rows.entries.size());
    }
    scale = check::random_scale(rows.rows());
  }
  PartialMatrix matrix() const { return {rows, pixels, scale, picture}; }
};

// Float weights: sums of some ten products, bound 20 roundings. What is no pixel of the product keeps its
// bits. Red if sums go to their place in the small picture (tried, on the CPU).
void expect_sums(const Problem& p, const std::vector<glm::vec4>& x, const std::vector<glm::vec4>& y) {
  std::vector<glm::dvec3> light;
  for (const glm::vec4& v : x) light.emplace_back(v);
  const std::vector<glm::vec3> sums = multiply(p.rows, light);
  std::vector<glm::vec3> expected(y.size(), glm::vec3(0.5f));
  std::vector<bool> listed(y.size(), false);
  for (size_t r = 0; r < sums.size(); ++r) {
    expected[p.pixels[r]] += sums[r] * p.scale[r];
    listed[p.pixels[r]] = true;
  }
  for (size_t i = 0; i < y.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      if (!listed[i]) {
        ASSERT_EQ(y[i][c], 0.5f) << i;
      } else {
        ASSERT_NEAR(y[i][c], expected[i][c], 1.2e-6f * (1.0f + std::abs(expected[i][c]))) << i;
      }
    }
}

TEST(PartialProduct, AddsToItsPixelsAndLeavesTheRestAloneInEveryForm) {
  const Problem p;
  ASSERT_GT(p.pixels.size(), 400u);
  const std::vector<glm::vec4> x = check::random_light(256);
  const std::vector<glm::vec4> start(static_cast<size_t>(picture.width * picture.height), glm::vec4(0.5f));
  ProductSettings settings;
  settings.weights = WeightFormat::float32;
  for (const char* form : {"rows", "tiles"}) {
    std::vector<glm::vec4> y = start;
    PartialProductCpu(form, p.matrix(), settings).add(x, y);
    expect_sums(p, x, y);
  }
  const auto context = gpu::Context::create("osmesa");
  for (const char* form : {"rows", "tiles", "quads"}) {
    const PartialProductGpu product(form, p.matrix(), settings, 1 << 24);
    const gpu::Buffer light = gpu::Buffer::from(x), result = gpu::Buffer::from(start);
    product.add(light, result);
    expect_sums(p, x, result.download<glm::vec4>());
  }
}

// Places for whole cells of 16x8 only. Red if a cell gets places for each of its pixels (tried).
TEST(PartialPicture, HasOnePlaceAPixelAndNoMoreCellsThanItNeeds) {
  std::vector<uint32_t> pixels;
  for (uint32_t y = 0; y < 8; ++y)
    for (uint32_t x = 0; x < 20; ++x) pixels.push_back(83 * y + x);  // cells (0,0) and (1,0)
  pixels.push_back(83 * 40 + 82);                                    // cell (5,5)
  const PartialPicture small(picture, pixels);
  EXPECT_LE(small.pixel_at().size(), 4u * 16u * 8u);
  std::vector<uint32_t> found;
  for (const uint32_t p : small.pixel_at())
    if (p != PartialPicture::no_pixel) found.push_back(p);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, pixels);
}

TEST(PartialPicture, RefusesPixelsOutsideThePictureOrOutOfOrder) {
  EXPECT_THROW(PartialPicture({4, 4}, std::vector<uint32_t>{16}), Error);
  EXPECT_THROW(PartialPicture({4, 4}, std::vector<uint32_t>{3, 3}), Error);
}

}  // namespace
}  // namespace relight
