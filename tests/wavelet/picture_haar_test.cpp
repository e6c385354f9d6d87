// Haar over the 4x4 tiles of a picture: what the inverse undoes, where coefficients lie, and the GPU's twin.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "common/gpu/context.h"
#include "common/run/error.h"
#include "common/sampling/random.h"
#include "common/wavelet/picture_haar_gpu.h"

namespace relight::wavelet {
namespace {

// A picture of random numbers and one of its coefficients; every third tile is not transformed.
struct Example {
  int width, height, across;
  std::vector<uint8_t> flags;
  PictureHaar haar;
  std::vector<glm::vec4> pixels, coefficients;

  Example(int w, int h)
      : width(w), height(h), across((w + 3) / 4), flags(make_flags(w, h)), haar(w, h, flags) {
    for (int i = 0; i < w * h; ++i) {
      const auto random = [&](uint64_t d) { return random_float(1, 2, static_cast<uint64_t>(i), d) - 0.5f; };
      pixels.emplace_back(random(0), random(1), random(2), 0.0f);
    }
    coefficients.resize(pixels.size());
    for (int channel = 0; channel < 3; ++channel)
      for (int t = 0; t < static_cast<int>(flags.size()); ++t) transform(t, channel);
  }
  static std::vector<uint8_t> make_flags(int w, int h) {
    std::vector<uint8_t> f;
    for (int t = 0; t < (w + 3) / 4 * ((h + 3) / 4); ++t) f.push_back(t % 3 != 2);
    return f;
  }
  void transform(int t, int channel) {
    const int left = t % across * 4, top = t / across * 4;
    std::array<float, 16> values{};
    for (int k = 0; k < 16; ++k) {
      const int x = left + k % 4, y = top + k / 4;
      if (x < width && y < height) values[static_cast<size_t>(k)] = pixels[index(x, y)][channel];
    }
    if (haar.transformed(t)) forward_tile(values);
    for (int k = 0; k < 16; ++k) {
      const int x = left + k % 4, y = top + k / 4;
      if (x < width && y < height) coefficients[haar.place(x, y)][channel] = values[static_cast<size_t>(k)];
    }
  }
  size_t index(int x, int y) const { return static_cast<size_t>(y * width + x); }
};

// Orthonormal: squares keep their sum, and a tile of one value is one coefficient, four times as large. Red
// if a level's factor is not 1/2, or a detail overwrites another (tried: the fine vertical details at the
// places of the horizontal ones).
TEST(PictureHaar, KeepsTheSumOfSquaresOfATile) {
  std::array<float, 16> values, constant;
  double before = 0.0, after = 0.0;
  for (size_t i = 0; i < 16; ++i) {
    values[i] = random_float(3, 4, i, 0);
    before += static_cast<double>(values[i]) * static_cast<double>(values[i]);
  }
  forward_tile(values);
  for (const float v : values) after += static_cast<double>(v) * static_cast<double>(v);
  EXPECT_NEAR(after, before, 1e-6 * before);
  constant.fill(0.25f);
  forward_tile(constant);
  EXPECT_FLOAT_EQ(constant[0], 1.0f);
  for (size_t i = 1; i < 16; ++i) EXPECT_EQ(constant[i], 0.0f) << i;
}

// Sizes that tiles fill, that they don't, and that hold no whole tile. Red if two coefficients share a place.
TEST(PictureHaar, PlacesAreAPermutationOfThePixels) {
  for (const auto& [w, h] : {std::pair{16, 8}, {30, 22}, {3, 2}, {4, 4}, {17, 3}}) {
    const Example e(w, h);
    std::vector<size_t> places;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) places.push_back(e.haar.place(x, y));
    std::sort(places.begin(), places.end());
    std::vector<size_t> expected(places.size());
    std::iota(expected.begin(), expected.end(), size_t{0});
    EXPECT_EQ(places, expected) << w << "x" << h;
  }
}

// What blocks of the sparse product count on: the coefficients beside each other are those of neighbours.
TEST(PictureHaar, TheSameCoefficientOfNeighbouringTilesIsSideBySide) {
  const Example e(32, 16);
  for (int k = 0; k < 16; ++k) {
    const int x = k % 4, y = k / 4;
    EXPECT_EQ(e.haar.place(4 + x, y), e.haar.place(x, y) + 1);
    EXPECT_EQ(e.haar.place(x, 4 + y), e.haar.place(x, y) + 32);
  }
}

// Five additions and two halvings of numbers below 4: bound 1e-6. Red if the inverse reads another place or
// sign (tried: the diagonal's sign; a tile at the border transformed).
TEST(PictureHaar, InverseGivesThePixelsBackTimesTheirFactors) {
  for (const auto& [w, h] : {std::pair{16, 8}, {30, 22}, {3, 2}}) {
    const Example e(w, h);
    std::vector<glm::vec3> factor;
    for (size_t i = 0; i < e.pixels.size(); ++i) factor.emplace_back(0.5f, 1.0f, static_cast<float>(i % 5));
    std::vector<glm::vec4> out(e.pixels.size());
    e.haar.inverse(e.coefficients, factor, out);
    for (size_t i = 0; i < out.size(); ++i) {
      const glm::vec3 expected = glm::vec3(e.pixels[i]) * factor[i];
      EXPECT_LT(glm::length(glm::vec3(out[i]) - expected), 4e-6f) << w << "x" << h << " pixel " << i;
      EXPECT_EQ(out[i].w, 0.0f);
    }
  }
}

// Red if GLSL and C++ read different places (tried: planes' width and height swapped).
TEST(PictureHaar, GpuAgreesWithTheCpu) {
  const auto context = gpu::Context::create("osmesa");
  for (const auto& [w, h] : {std::pair{16, 8}, {30, 22}, {3, 2}}) {
    const Example e(w, h);
    std::vector<glm::vec3> factor;
    for (size_t i = 0; i < e.pixels.size(); ++i) factor.emplace_back(0.5f, 1.0f, static_cast<float>(i % 5));
    std::vector<glm::vec4> cpu(e.pixels.size());
    e.haar.inverse(e.coefficients, factor, cpu);
    const PictureHaarGpu gpu(e.haar, factor);
    const gpu::Buffer in = gpu::Buffer::from(e.coefficients), out(in.bytes());
    gpu.inverse(in, out);
    const std::vector<glm::vec4> result = out.download<glm::vec4>();
    for (size_t i = 0; i < cpu.size(); ++i)
      EXPECT_LT(glm::length(result[i] - cpu[i]), 4e-6f) << w << "x" << h << " pixel " << i;
  }
}

TEST(PictureHaar, RefusesAnotherNumberOfTiles) {
  EXPECT_THROW(PictureHaar(16, 8, std::vector<uint8_t>(7)), Error);
}

}  // namespace
}  // namespace relight::wavelet
