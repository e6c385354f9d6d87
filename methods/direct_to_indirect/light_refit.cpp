#include "methods/direct_to_indirect/light_refit.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <cblas.h>

#include "common/run/error.h"

// LAPACK, part of OpenBLAS, column-major: Cholesky factor, inverse of a triangle, solution from the factor.
extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dtrtri_(const char* uplo, const char* diag, const int* n, double* a, const int* lda, int* info);
void dpotrs_(const char* uplo, const int* n, const int* nrhs, const double* a, const int* lda, double* b,
             const int* ldb, int* info);
}

namespace relight::direct_to_indirect {
namespace {

// Coefficients multiplied at a time: their responses to 1,024 lights fill a quarter of a megabyte, so that
// they stay in the second-level cache.
constexpr size_t block_size = 64;

// Surplus candidates are dropped in this many equal portions, refitting in between.
constexpr size_t elimination_rounds = 3;

// Share of the mean that every coefficient's ridge has at least: one that no training light excites keeps the
// normal equations positive definite, and its value.
constexpr double stiffness_floor = 1e-3;

// C += A^T B with A (rows x lanes), B (rows x width), C (lanes x width), all row-major.
void add_product(const float* a, const float* b, size_t rows, size_t width, float* c) {
  cblas_sgemm(CblasRowMajor, CblasTrans, CblasNoTrans, lanes, static_cast<int>(width), static_cast<int>(rows),
              1.0f, a, lanes, b, static_cast<int>(width), 1.0f, c, static_cast<int>(width));
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

void LightRefit::refit(const std::vector<LaneCoefficient>& all, std::array<RefitRow, lanes>& rows) {
  gather_answers(all);
  weigh_lights();
  gather_candidates(rows);
  if (columns_.empty()) return;
  const int n = static_cast<int>(columns_.size()), lights = static_cast<int>(training_.count);
  gram_.assign(columns_.size() * columns_.size(), 0.0f);
  cblas_ssyrk(CblasRowMajor, CblasLower, CblasNoTrans, n, lights, 1.0f, packed_.data(), lights, 0.0f,
              gram_.data(), n);
  right_sides_.assign(columns_.size() * lanes, 0.0f);
  cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasTrans, n, lanes, lights, 1.0f, packed_.data(), lights,
              answers_.data(), lights, 0.0f, right_sides_.data(), lanes);
  for (size_t i = 0; i < lanes; ++i)
    if (!rows[i].entries.empty()) reduce(rows[i], i);
}

// Answers of the whole rows.
void LightRefit::gather_answers(const std::vector<LaneCoefficient>& all) {
  const size_t lights = training_.count;
  answers_.assign(lanes * lights, 0.0f);
  block_.resize(block_size * lights);
  std::array<Lanes, block_size> values;
  for (size_t first = 0; first < all.size(); first += block_size) {
    const size_t count = std::min(block_size, all.size() - first);
    for (size_t i = 0; i < count; ++i) {
      values[i] = all[first + i].value;
      std::copy_n(response(all[first + i].index), lights, block_.data() + i * lights);
    }
    add_product(values[0].data(), block_.data(), count, lights, answers_.data());
  }
}

// A light next to the tile would otherwise outweigh all that light it from afar. Fully relative weights
// (without `mean`) make small answers darker still: docs/accuracy.md.
void LightRefit::weigh_lights() {
  const size_t lights = training_.count;
  weights_.assign(lights, 0.0f);
  float mean = 0.0f;
  for (size_t t = 0; t < lights; ++t) {
    for (size_t i = 0; i < lanes; ++i) weights_[t] += answers_[i * lights + t] * answers_[i * lights + t];
    mean += weights_[t] / static_cast<float>(lights);
  }
  for (float& w : weights_) w = mean > 0.0f ? 1.0f / std::sqrt(w + mean) : 0.0f;
  for (size_t i = 0; i < lanes; ++i)
    for (size_t t = 0; t < lights; ++t) answers_[i * lights + t] *= weights_[t];
}

void LightRefit::gather_candidates(const std::array<RefitRow, lanes>& rows) {
  columns_.clear();
  for (const RefitRow& row : rows)
    for (const SparseEntry& e : row.entries) columns_.push_back(e.column);
  std::sort(columns_.begin(), columns_.end());
  columns_.erase(std::unique(columns_.begin(), columns_.end()), columns_.end());
  packed_.resize(columns_.size() * training_.count);
  for (size_t k = 0; k < columns_.size(); ++k)
    std::transform(weights_.begin(), weights_.end(), response(columns_[k]),
                   packed_.data() + k * training_.count, std::multiplies<float>());
}

// Drops candidates until `target` are left and gives these the values that fit best.
void LightRefit::reduce(RefitRow& row, size_t lane) {
  if (row.target == 0) return row.entries.clear();
  set_up(row, lane);
  const size_t step = (row.entries.size() - row.target + elimination_rounds - 1) / elimination_rounds;
  solve();
  while (left_.size() > row.target) {
    drop_least(std::min(step, left_.size() - row.target));
    solve();
  }
  for (size_t p = 0; p < left_.size(); ++p)
    row.entries[p] = {columns_[left_[p]], static_cast<float>(solution_[p])};
  row.entries.resize(left_.size());
}

// Places of the row's candidates among the tile's columns, their values and the ridge. Where no training
// light excites any of them, the values stay and the largest are kept.
void LightRefit::set_up(const RefitRow& row, size_t lane) {
  const size_t n = columns_.size();
  left_.clear(), prior_.clear(), stiffness_.clear(), right_.clear();
  double trace = 0.0;
  size_t k = 0;
  for (const SparseEntry& e : row.entries) {  // ascending, too
    while (columns_[k] != e.column) ++k;
    left_.push_back(k);
    prior_.push_back(static_cast<double>(e.value));
    right_.push_back(static_cast<double>(right_sides_[k * lanes + lane]));
    stiffness_.push_back(static_cast<double>(gram_[k * n + k]));
    trace += stiffness_.back();
  }
  const double floor = stiffness_floor * trace / static_cast<double>(row.entries.size());
  for (double& s : stiffness_) s = trace > 0.0 ? ridge_ * (s + floor) : 1.0;
}

// The normal equations (H_SS + M) w = G_S W^2 y + M c_S, M the ridge, of what is left, in double; leaves the
// Cholesky factor in matrix_.
void LightRefit::solve() {
  const size_t n = columns_.size(), size = left_.size();
  matrix_.resize(size * size);
  solution_.resize(size);
  for (size_t p = 0; p < size; ++p) {
    for (size_t q = 0; q <= p; ++q)
      matrix_[p * size + q] = static_cast<double>(gram_[left_[p] * n + left_[q]]);
    matrix_[p * size + p] += stiffness_[p];
    solution_[p] = right_[p] + stiffness_[p] * prior_[p];
  }
  const int order = static_cast<int>(size), one = 1;
  int info = 0;
  // Row-major lower is column-major upper.
  dpotrf_("U", &order, matrix_.data(), &order, &info);
  if (info != 0)
    fail("refit: the normal equations of a row of {} coefficients are not positive definite", size);
  dpotrs_("U", &order, &one, matrix_.data(), &order, solution_.data(), &order, &info);
}

// Drops the `count` entries with the smallest saliency w_p^2 / (A^-1)_pp; with A = U^T U and X = U^-1 the
// diagonal of the inverse has the squared norms of X's rows.
void LightRefit::drop_least(size_t count) {
  const size_t size = left_.size();
  const int order = static_cast<int>(size);
  int info = 0;
  dtrtri_("U", "N", &order, matrix_.data(), &order, &info);
  saliency_.assign(size, {0.0, 0});
  for (size_t q = 0; q < size; ++q)
    for (size_t p = 0; p <= q; ++p) saliency_[p].first += matrix_[q * size + p] * matrix_[q * size + p];
  for (size_t p = 0; p < size; ++p) saliency_[p] = {solution_[p] * solution_[p] / saliency_[p].first, p};
  std::nth_element(saliency_.begin(), saliency_.begin() + static_cast<std::ptrdiff_t>(count),
                   saliency_.end());
  saliency_.resize(count);
  std::sort(saliency_.begin(), saliency_.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  size_t kept = 0, next = 0;
  for (size_t p = 0; p < size; ++p) {
    if (next < count && saliency_[next].second == p) {
      ++next;
      continue;
    }
    left_[kept] = left_[p], prior_[kept] = prior_[p], stiffness_[kept] = stiffness_[p];
    right_[kept] = right_[p];
    ++kept;
  }
  left_.resize(kept), prior_.resize(kept), stiffness_.resize(kept), right_.resize(kept);
}

}  // namespace relight::direct_to_indirect
