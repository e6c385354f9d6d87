#include "methods/direct_to_indirect/light_refit.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <cblas.h>

#include "common/run/error.h"

// LAPACK, part of OpenBLAS: solves A X = B for a positive definite A by Cholesky factorisation.
extern "C" void dposv_(const char* uplo, const int* n, const int* nrhs, double* a, const int* lda, double* b,
                       const int* ldb, int* info);

namespace relight::direct_to_indirect {
namespace {

// Coefficients multiplied at a time: their responses to 1,024 lights fill a quarter of a megabyte, so that
// they stay in the second-level cache.
constexpr size_t block_size = 64;

// C += factor A^T B with A (rows x lanes), B (rows x width), C (lanes x width), all row-major.
void add_product(const float* a, const float* b, size_t rows, size_t width, float factor, float* c) {
  cblas_sgemm(CblasRowMajor, CblasTrans, CblasNoTrans, lanes, static_cast<int>(width), static_cast<int>(rows),
              factor, a, lanes, b, static_cast<int>(width), 1.0f, c, static_cast<int>(width));
}

}  // namespace

LightRefit::LightRefit(const TrainingLights& training, float ridge)
    : training_(training), ridge_(static_cast<double>(ridge)) {
  // The serial variant of the library keeps unguarded global buffers: called from several threads, it gives
  // wrong numbers without a word.
  if (openblas_get_parallel() == 0)
    fail(
        "refit: the serial variant of OpenBLAS is installed, which is not safe to call from several threads; "
        "install libopenblas0-pthread");
  openblas_set_num_threads(1);  // tasks are the threads
}

void LightRefit::refit(const std::vector<LaneCoefficient>& all,
                       const std::array<std::span<SparseEntry>, lanes>& kept) {
  gather_residual(all);
  weigh_lights();
  gather_kept(kept);
  if (columns_.empty()) return;
  const size_t n = columns_.size(), lights = training_.count;
  add_product(values_.data(), packed_.data(), n, lights, -1.0f, residual_.data());
  gram_.assign(n * n, 0.0f);
  cblas_ssyrk(CblasRowMajor, CblasLower, CblasNoTrans, static_cast<int>(n), static_cast<int>(lights), 1.0f,
              packed_.data(), static_cast<int>(lights), 0.0f, gram_.data(), static_cast<int>(n));
  target_.assign(n * lanes, 0.0f);
  cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasTrans, static_cast<int>(n), lanes, static_cast<int>(lights),
              1.0f, packed_.data(), static_cast<int>(lights), residual_.data(), static_cast<int>(lights),
              0.0f, target_.data(), lanes);
  for (size_t i = 0; i < lanes; ++i)
    if (!kept[i].empty()) solve(kept[i], i);
}

// Answers of the whole rows.
void LightRefit::gather_residual(const std::vector<LaneCoefficient>& all) {
  const size_t lights = training_.count;
  residual_.assign(lanes * lights, 0.0f);
  block_.resize(block_size * lights);
  std::array<Lanes, block_size> values;
  for (size_t first = 0; first < all.size(); first += block_size) {
    const size_t count = std::min(block_size, all.size() - first);
    for (size_t i = 0; i < count; ++i) {
      values[i] = all[first + i].value;
      std::copy_n(response(all[first + i].index), lights, block_.data() + i * lights);
    }
    add_product(values[0].data(), block_.data(), count, lights, 1.0f, residual_.data());
  }
}

// A light next to the tile would otherwise outweigh all that light it from afar. Fully relative weights
// (without `mean`) make small answers darker still: docs/accuracy.md.
void LightRefit::weigh_lights() {
  const size_t lights = training_.count;
  weights_.assign(lights, 0.0f);
  float mean = 0.0f;
  for (size_t t = 0; t < lights; ++t) {
    for (size_t i = 0; i < lanes; ++i) weights_[t] += residual_[i * lights + t] * residual_[i * lights + t];
    mean += weights_[t] / static_cast<float>(lights);
  }
  for (float& w : weights_) w = mean > 0.0f ? 1.0f / std::sqrt(w + mean) : 0.0f;
  for (size_t i = 0; i < lanes; ++i)
    for (size_t t = 0; t < lights; ++t) residual_[i * lights + t] *= weights_[t];
}

void LightRefit::gather_kept(const std::array<std::span<SparseEntry>, lanes>& kept) {
  columns_.clear();
  for (const auto& row : kept)
    for (const SparseEntry& e : row) columns_.push_back(e.column);
  std::sort(columns_.begin(), columns_.end());
  columns_.erase(std::unique(columns_.begin(), columns_.end()), columns_.end());
  packed_.resize(columns_.size() * training_.count);
  for (size_t k = 0; k < columns_.size(); ++k)
    std::transform(weights_.begin(), weights_.end(), response(columns_[k]),
                   packed_.data() + k * training_.count, std::multiplies<float>());
  values_.assign(columns_.size() * lanes, 0.0f);
  for (size_t i = 0; i < lanes; ++i) {
    size_t k = 0;
    for (const SparseEntry& e : kept[i]) {  // ascending, too
      while (columns_[k] != e.column) ++k;
      values_[k * lanes + i] = e.value;
    }
  }
}

// The normal equations of one row, in double.
void LightRefit::solve(std::span<SparseEntry> row, size_t lane) {
  const size_t n = columns_.size(), size = row.size();
  std::vector<size_t> at(size);
  for (size_t p = 0, k = 0; p < size; ++p) {
    while (columns_[k] != row[p].column) ++k;
    at[p] = k;
  }
  matrix_.assign(size * size, 0.0);
  right_.resize(size);
  double trace = 0.0;
  for (size_t p = 0; p < size; ++p) {
    right_[p] = static_cast<double>(target_[at[p] * lanes + lane]);
    for (size_t q = 0; q <= p; ++q) matrix_[p * size + q] = static_cast<double>(gram_[at[p] * n + at[q]]);
    trace += matrix_[p * size + p];
  }
  if (!(trace > 0.0)) return;  // no training light excites what the row keeps
  for (size_t p = 0; p < size; ++p) matrix_[p * size + p] += ridge_ * trace / static_cast<double>(size);
  const int order = static_cast<int>(size), one = 1;
  int info = 0;
  // Row-major lower is column-major upper.
  dposv_("U", &order, &one, matrix_.data(), &order, right_.data(), &order, &info);
  if (info != 0)
    fail("refit: the normal equations of a row of {} coefficients are not positive definite", size);
  for (size_t p = 0; p < size; ++p) row[p].value += static_cast<float>(right_[p]);
}

}  // namespace relight::direct_to_indirect
