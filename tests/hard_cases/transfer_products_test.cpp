// Matrices and lights that are hard on the forms of the transfer product.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "common/gpu/context.h"
#include "common/linalg/product_list.h"
#include "common/sampling/random.h"
#include "tests/linalg/product_check.h"

namespace relight {
namespace {

struct Form {
  std::string device, name;
};
const std::vector<Form> forms = {
    {"gpu", "rows"}, {"gpu", "tiles"}, {"gpu", "quads"}, {"cpu", "rows"}, {"cpu", "tiles"}};

std::vector<glm::vec4> product(const Form& form, const SparseRows& m, PictureShape shape,
                               const std::vector<glm::vec4>& x, const ProductSettings& settings) {
  const std::vector<glm::vec3> scale(m.rows(), glm::vec3(1.0f));
  std::unique_ptr<TransferProduct> p;
  if (form.device == "cpu")
    p = make_product_cpu(form.name, m, scale, shape, settings);
  else
    p = make_product_gpu(form.name, m, scale, shape, settings, 1 << 27);
  std::vector<glm::vec4> y(m.rows(), glm::vec4(-1.0f));
  p->multiply(x, y);
  return y;
}

// Every pixel has the same columns; weight(pixel, column).
template <typename Weight>
SparseRows full_matrix(size_t rows, uint32_t columns, Weight weight) {
  SparseRows m;
  m.columns = columns;
  m.row_start.push_back(0);
  for (size_t r = 0; r < rows; ++r) {
    for (uint32_t c = 0; c < columns; ++c) m.entries.push_back({c, weight(r, c)});
    m.row_start.push_back(m.entries.size());
  }
  return m;
}

const std::vector<glm::vec4> one_light = {glm::vec4(1.0f, 1.0f, 1.0f, 0.0f)};

// One texel of 1 in a block of 16x8 texels between 0.001 and 0.002: eight bits for the whole block are steps
// of 1/255, so that the forms with a scale a block keep nothing of the others but a bound of half a step.
// Sixteen bits keep them to 1.6 %, and a scale a row (rows; on the CPU tiles too) is not touched by what
// other pixels hold. (No mutation was tried.)
TEST(HardProducts, ADominantTexelCostsABlockItsBitsButNeverMoreThanHalfAStep) {
  const auto context = gpu::Context::create("osmesa");
  const auto dim = [](size_t r) { return 0.001f + 0.001f * random_float(1, r, 0, 0); };
  const SparseRows m = full_matrix(128, 1, [&](size_t r, uint32_t) { return r == 77 ? 1.0f : dim(r); });
  for (const Form& form : forms) {
    for (const WeightFormat format : {WeightFormat::bits8, WeightFormat::bits16}) {
      ProductSettings settings;
      settings.weights = format;
      const std::vector<glm::vec4> y = product(form, m, {16, 8}, one_light, settings);
      const float half_step = 0.5f / static_cast<float>(largest_integer(format));
      const bool scale_a_row = form.name == "rows" || form.device == "cpu";
      for (size_t r = 0; r < 128; ++r) {
        const float exact = m.entries[r].value;
        const float bound = scale_a_row ? 1e-6f * exact : 1.0001f * half_step;
        ASSERT_NEAR(y[r].x, exact, bound)
            << form.device << " " << form.name << " " << to_string(format) << ", pixel " << r;
      }
      EXPECT_NEAR(y[77].x, 1.0f, 1e-5f) << form.device << " " << form.name;
    }
  }
}

// Lights between 1e-6 and 1 of either sign, 200 a pixel; the bound is that of any order of float additions.
// Tried: a blending target of 16 bits is red.
TEST(HardProducts, LightsSixOrdersOfMagnitudeApartStayWithinFloatRounding) {
  const auto context = gpu::Context::create("osmesa");
  const SparseRows m =
      full_matrix(192, 200, [](size_t r, uint32_t c) { return random_float(2, r, c, 0) - 0.5f; });
  std::vector<glm::vec4> x(200);
  for (size_t c = 0; c < x.size(); ++c) {
    const float magnitude = std::pow(10.0f, -6.0f * random_float(3, c, 0, 0));
    x[c] = glm::vec4(magnitude, -magnitude, c % 2 == 0 ? magnitude : -magnitude, 0.0f);
  }
  const std::vector<glm::vec3> scale(192, glm::vec3(1.0f));
  const std::vector<float> exact_weights(192, 0.0f);
  for (const Form& form : forms) {
    SCOPED_TRACE(form.device + " " + form.name);
    ProductSettings settings;
    settings.weights = WeightFormat::float32;
    check::expect_product(m, x, scale, product(form, m, {16, 12}, x, settings), exact_weights);
  }
}

// 100,000 layers of 1e-5 blended over each other add up to 1. A float32 target must be within its bound. A
// float16 target stops growing where one layer is less than a rounding of the sum: llvmpipe, which rounds
// blending towards zero, stops at 2^-6 = 0.0156, 1.6 % of the light; rounding to nearest would stop at twice
// that. That is what the setting costs, and why float32 is the default. Tried: the two formats of the target
// swapped is red.
TEST(HardProducts, AHundredThousandBlendedLayersNeedFloat32) {
  const auto context = gpu::Context::create("osmesa");
  const uint32_t layers = 100000;
  const SparseRows m = full_matrix(16, layers, [](size_t, uint32_t) { return 1e-5f; });
  const std::vector<glm::vec4> x(layers, glm::vec4(1.0f));
  ProductSettings settings;
  settings.weights = WeightFormat::float32;
  for (const glm::vec4& y : product({"gpu", "quads"}, m, {4, 4}, x, settings)) ASSERT_NEAR(y.x, 1.0f, 2e-3f);
  settings.partial_results = PartialResults::float16;
  for (const glm::vec4& y : product({"gpu", "quads"}, m, {4, 4}, x, settings)) {
    ASSERT_LT(y.x, 0.04f) << "a float16 target that loses nothing is no float16 target";
    ASSERT_GT(y.x, 0.01f);
  }
}

// Rows that are constant, zero, a single spike, or empty, side by side in one block. Tried: red with a step
// of 0 for zero rows and a 16-bit target (together).
TEST(HardProducts, ConstantZeroSpikeAndEmptyRowsComeOutAsWhatTheyAre) {
  const auto context = gpu::Context::create("osmesa");
  SparseRows m;
  m.columns = 64;
  m.row_start.push_back(0);
  for (size_t r = 0; r < 96; ++r) {
    for (uint32_t c = 0; c < 64; ++c) {
      if (r % 4 == 0) m.entries.push_back({c, 0.25f});
      if (r % 4 == 1) m.entries.push_back({c, 0.0f});
      if (r % 4 == 2 && c == 31) m.entries.push_back({c, -1e4f});
    }
    m.row_start.push_back(m.entries.size());
  }
  const std::vector<glm::vec4> x(64, glm::vec4(1.0f));
  for (const Form& form : forms) {
    for (const WeightFormat format : {WeightFormat::float32, WeightFormat::bits16, WeightFormat::bits8}) {
      ProductSettings settings;
      settings.weights = format;
      const std::vector<glm::vec4> y = product(form, m, {12, 8}, x, settings);
      for (size_t r = 0; r < 96; ++r) {
        SCOPED_TRACE(form.device + " " + form.name + " " + to_string(format) + ", row " + std::to_string(r));
        // Column 31 has a block with spikes and 0.25: each may be off by half a step of the range of 1e4.
        const bool a_step_a_block = form.name == "quads" || (form.name == "tiles" && form.device == "gpu");
        const float half_step = a_step_a_block && format != WeightFormat::float32
                                    ? 0.5001e4f / static_cast<float>(largest_integer(format))
                                    : 0.0f;
        if (r % 4 == 0) {
          ASSERT_NEAR(y[r].x, 16.0f, 1e-4f + half_step);
        } else if (r % 4 == 2) {
          ASSERT_NEAR(y[r].x, -1e4f, 1e-2f + half_step);
        } else {
          ASSERT_EQ(glm::vec3(y[r]), glm::vec3(0.0f));
        }
      }
    }
  }
}

// A view that sees nothing has rows, but no entries; a matrix may have no rows at all. (No mutation was
// tried.)
TEST(HardProducts, NothingToMultiplyGivesBlackAndNoError) {
  const auto context = gpu::Context::create("osmesa");
  SparseRows blind;
  blind.columns = 16;
  blind.row_start.assign(20 * 3 + 1, 0);
  SparseRows none;
  none.columns = 16;
  const std::vector<glm::vec4> x(16, glm::vec4(3.0f));
  for (const Form& form : forms) {
    for (const float epsilon : {-1.0f, 0.0f, 0.1f}) {
      SCOPED_TRACE(form.device + " " + form.name);
      ProductSettings settings;
      settings.cull_epsilon = epsilon;
      for (const glm::vec4& y : product(form, blind, {20, 3}, x, settings)) ASSERT_EQ(y, glm::vec4(0.0f));
      EXPECT_TRUE(product(form, none, {0, 0}, x, settings).empty());
    }
  }
}

}  // namespace
}  // namespace relight
