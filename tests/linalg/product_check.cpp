#include "tests/linalg/product_check.h"

#include <cmath>

#include <gtest/gtest.h>

#include "common/hard_cases/product_cases.h"
#include "common/sampling/random.h"

namespace relight::check {

SparseRows random_matrix(size_t rows, uint32_t columns, float density) {
  SparseRows m;
  m.columns = columns;
  m.row_start.push_back(0);
  for (size_t r = 0; r < rows; ++r) {
    for (uint32_t c = 0; c < columns && r % 7 != 0; ++c)
      if (random_float(3, r, c, 0) < density) m.entries.push_back({c, random_float(3, r, c, 1) - 0.5f});
    m.row_start.push_back(m.entries.size());
  }
  return m;
}

SparseRows image_like_matrix(int width, int height, uint32_t columns, int mean_entries) {
  SparseRows m;
  m.columns = columns;
  m.row_start.push_back(0);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool blind =
          random_float(9, static_cast<uint64_t>(x / 8), static_cast<uint64_t>(y / 8), 0) < 0.1f;
      for (uint32_t c = 0; c < columns && !blind; ++c) {
        const float cx = random_float(8, c, 0, 0) * static_cast<float>(width);
        const float cy = random_float(8, c, 1, 0) * static_cast<float>(height);
        // A harmonic series of areas: their sum over the columns gives the mean number a pixel.
        const float series = std::log(static_cast<float>(columns) + 1.0f);
        const float area =
            static_cast<float>(width * height * mean_entries) / series / static_cast<float>(c + 1);
        const float dx = static_cast<float>(x) - cx, dy = static_cast<float>(y) - cy;
        const float d = (dx * dx + dy * dy) * 3.1416f / area;
        if (d < 1.0f) m.entries.push_back({c, (1.0f - d) * (random_float(8, c, 2, 0) - 0.4f)});
      }
      m.row_start.push_back(m.entries.size());
    }
  }
  return m;
}

std::vector<glm::vec4> random_light(uint32_t columns) {
  std::vector<glm::vec4> x(columns);
  for (size_t i = 0; i < x.size(); ++i)
    x[i] =
        glm::vec4(random_float(4, i, 0, 0) - 0.3f, random_float(4, i, 1, 0), random_float(4, i, 2, 0), 7.0f);
  return x;
}

std::vector<glm::vec3> random_scale(size_t rows) {
  std::vector<glm::vec3> scale(rows);
  for (size_t r = 0; r < rows; ++r) scale[r] = glm::vec3(random_float(5, r, 0, 0), 0.5f, 1.0f);
  return scale;
}

void expect_product(const SparseRows& m, std::span<const glm::vec4> x, std::span<const glm::vec3> scale,
                    std::span<const glm::vec4> y, std::span<const float> steps) {
  ASSERT_EQ(y.size(), m.rows());
  size_t row = 0;
  ASSERT_LE(hard::product_error_over_bound(m, x, scale, y, steps, row), 1.0) << "row " << row;
  for (size_t r = 0; r < m.rows(); ++r) ASSERT_EQ(y[r].w, 0.0f) << "row " << r;
}

std::vector<float> row_steps(const SparseRows& m, WeightFormat format) {
  std::vector<float> steps(m.rows(), 0.0f);
  if (format != WeightFormat::float32)
    for (size_t r = 0; r < m.rows(); ++r) steps[r] = quantisation_step(m.row(r), format);
  return steps;
}

}  // namespace relight::check
