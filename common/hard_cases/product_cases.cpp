#include "common/hard_cases/product_cases.h"

#include <cmath>
#include <memory>

#include "common/gpu/context.h"
#include "common/linalg/product_list.h"
#include "common/sampling/random.h"

namespace relight::hard {

namespace {

struct Form {
  std::string device, name;
  // Eight bits for a block of texels, not for a row.
  bool step_a_block() const { return name == "quads" || (name == "tiles" && device == "gpu"); }
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

ProductSettings with(WeightFormat format) {
  ProductSettings settings;
  settings.weights = format;
  return settings;
}

// Not a number if one of the two is.
void keep_largest(double& largest, double value) {
  if (!(value <= largest)) largest = value;
}

double error(float measured, float exact) {
  return std::abs(static_cast<double>(measured) - static_cast<double>(exact));
}

// One texel of 1 in a block of 16x8 texels between 0.001 and 0.002.
Figures dominant_texel() {
  const auto context = gpu::Context::create("osmesa");
  const auto dim = [](size_t r) { return 0.001f + 0.001f * random_float(1, r, 0, 0); };
  const SparseRows m = full_matrix(128, 1, [&](size_t r, uint32_t) { return r == 77 ? 1.0f : dim(r); });
  double of_block = 0.0, of_row = 0.0, bright = 0.0;
  for (const Form& form : forms)
    for (const WeightFormat format : {WeightFormat::bits8, WeightFormat::bits16}) {
      const auto y = product(form, m, {16, 8}, {glm::vec4(1.0f, 1.0f, 1.0f, 0.0f)}, with(format));
      const double half_step = 0.5 / largest_integer(format);
      for (size_t r = 0; r < 128; ++r) {
        const float exact = m.entries[r].value;
        if (form.step_a_block())
          keep_largest(of_block, error(y[r].x, exact) / half_step);
        else
          keep_largest(of_row, error(y[r].x, exact) / static_cast<double>(exact));
      }
      keep_largest(bright, error(y[77].x, 1.0f));
    }
  return {at_most("error in half steps of the block, 8 and 16 bits", of_block, 1.0001,
                  "a weight is rounded to the nearest of the integers that its block is stored in"),
          at_most("relative error with a scale a row", of_row, 1e-6,
                  "what other pixels hold does not touch a row; float rounding is left"),
          at_most("error of the bright texel", bright, 1e-5, "it is the largest integer itself")};
}

// Lights between 1e-6 and 1 of either sign, 200 a pixel.
Figures six_orders_of_magnitude() {
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
  double worst = 0.0;
  size_t row = 0;
  for (const Form& form : forms) {
    const auto y = product(form, m, {16, 12}, x, with(WeightFormat::float32));
    keep_largest(worst, product_error_over_bound(m, x, scale, y, exact_weights, row));
  }
  return {at_most("error over the rounding bound of 200 float products", worst, 1.0,
                  "n products summed in any order lose at most n + 2 roundings of their magnitudes")};
}

// 100,000 layers of 1e-5, blended over each other, add up to 1.
Figures blended_layers() {
  const auto context = gpu::Context::create("osmesa");
  constexpr uint32_t layers = 100000;
  const SparseRows m = full_matrix(16, layers, [](size_t, uint32_t) { return 1e-5f; });
  const std::vector<glm::vec4> x(layers, glm::vec4(1.0f));
  ProductSettings settings = with(WeightFormat::float32);
  double of_float32 = 0.0, most = 0.0, least = 1.0;
  for (const glm::vec4& y : product({"gpu", "quads"}, m, {4, 4}, x, settings))
    keep_largest(of_float32, error(y.x, 1.0f));
  settings.partial_results = PartialResults::float16;
  for (const glm::vec4& y : product({"gpu", "quads"}, m, {4, 4}, x, settings)) {
    keep_largest(most, static_cast<double>(y.x));
    least = std::min(least, static_cast<double>(y.x));
  }
  return {
      at_most("error of the sum in a float32 target", of_float32, 2e-3,
              "100,000 roundings of 2^-24, not all of one sign: a third of the worst case"),
      at_most("sum in a float16 target", most, 0.04,
              "it stops where a layer is less than a rounding, at 2^-6 or twice that: a setting that loses "
              "nothing is no float16 target, and float32 is the default because of this"),
      at_least("sum in a float16 target, least", least, 0.01, "2^-6, less a rounding")};
}

SparseRows four_kinds_of_rows() {
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
  return m;
}

// Rows that are constant, zero, a single spike, or empty, side by side in one block.
Figures constant_zero_and_spikes() {
  const auto context = gpu::Context::create("osmesa");
  const SparseRows m = four_kinds_of_rows();
  const std::vector<glm::vec4> x(64, glm::vec4(1.0f));
  double constant = 0.0, spike = 0.0, nothing = 0.0;
  for (const Form& form : forms)
    for (const WeightFormat format : {WeightFormat::float32, WeightFormat::bits16, WeightFormat::bits8}) {
      const auto y = product(form, m, {12, 8}, x, with(format));
      // Column 31 has a block with spikes and 0.25: each may be off by half a step of the range of 1e4.
      const bool coarse = form.step_a_block() && format != WeightFormat::float32;
      const double half_step = coarse ? 0.5001e4 / largest_integer(format) : 0.0;
      for (size_t r = 0; r < 96; ++r) {
        if (r % 4 == 0) keep_largest(constant, error(y[r].x, 16.0f) / (1e-4 + half_step));
        if (r % 4 == 2) keep_largest(spike, error(y[r].x, -1e4f) / (1e-2 + half_step));
        if (r % 4 == 1 || r % 4 == 3)
          keep_largest(nothing, static_cast<double>(glm::length(glm::vec3(y[r]))));
      }
    }
  return {at_most("error of constant rows over (1e-4 + half a step of their block)", constant, 1.0,
                  "64 float products of 0.25, and half a step of the range of a block with a spike"),
          at_most("error of spikes over (1e-2 + half a step of their block)", spike, 1.0,
                  "rounding of 1e4, and half a step"),
          at_most("light of zero and empty rows", nothing, 0.0, "zero is stored exactly in every format")};
}

// A view that sees nothing has rows, but no entries; a matrix may have no rows at all.
Figures nothing_to_multiply() {
  const auto context = gpu::Context::create("osmesa");
  SparseRows blind;
  blind.columns = 16;
  blind.row_start.assign(20 * 3 + 1, 0);
  SparseRows none;
  none.columns = 16;
  const std::vector<glm::vec4> x(16, glm::vec4(3.0f));
  double light = 0.0, rows = 0.0;
  for (const Form& form : forms)
    for (const float epsilon : {-1.0f, 0.0f, 0.1f}) {
      ProductSettings settings;
      settings.cull_epsilon = epsilon;
      for (const glm::vec4& y : product(form, blind, {20, 3}, x, settings))
        keep_largest(light, static_cast<double>(glm::length(y)));
      rows += static_cast<double>(product(form, none, {0, 0}, x, settings).size());
    }
  return {at_most("light of rows without entries", light, 0.0, "nothing is added to it"),
          at_most("rows of the product of no rows", rows, 0.0, "there is nothing to write")};
}

}  // namespace

double product_error_over_bound(const SparseRows& m, std::span<const glm::vec4> x,
                                std::span<const glm::vec3> scale, std::span<const glm::vec4> y,
                                std::span<const float> steps, size_t& row) {
  double worst = 0.0;
  for (size_t r = 0; r < m.rows(); ++r) {
    glm::dvec3 sum(0.0), magnitude(0.0), light(0.0);
    for (const SparseEntry& e : m.row(r)) {
      const glm::dvec3 l(x[e.column]);
      sum += static_cast<double>(e.value) * l;
      magnitude += std::abs(static_cast<double>(e.value)) * glm::abs(l);
      light += glm::abs(l);
    }
    const double roundings = static_cast<double>(m.row(r).size() + 2) * 0x1p-24;
    const glm::dvec3 bound =
        0.5 * (1.0 + roundings) * static_cast<double>(steps[r]) * light + roundings * magnitude;
    for (int c = 0; c < 3; ++c) {
      const double s = static_cast<double>(scale[r][c]);
      const double over =
          std::abs(static_cast<double>(y[r][c]) - s * sum[c]) / (1.0001 * s * bound[c] + 1e-37);
      if (!(over <= worst)) worst = over, row = r;
    }
  }
  return worst;
}

Cases product_cases() {
  return {
      {"a dominant texel in a block of dim ones", "Eight bits for a whole block keep nothing of the others.",
       dominant_texel},
      {"lights six orders of magnitude apart", "Small lights drown in large ones of the other sign.",
       six_orders_of_magnitude},
      {"100,000 blended layers", "Each layer is less than a rounding of the sum.", blended_layers},
      {"constant, zero, spike and empty rows", "A step of zero divides by zero.", constant_zero_and_spikes},
      {"nothing to multiply", "Empty buffers and pictures of no pixels.", nothing_to_multiply}};
}

}  // namespace relight::hard
