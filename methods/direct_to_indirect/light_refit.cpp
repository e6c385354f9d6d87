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

LightRefit::LightRefit(const TrainingLights& training, float ridge, size_t largest_fit)
    : training_(training), ridge_(static_cast<double>(ridge)), largest_fit_(largest_fit) {
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
  if (columns_.size() <= largest_fit_) multiply(packed_.data(), columns_.size());
  right_sides_.assign(columns_.size() * lanes, 0.0f);
  cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasTrans, n, lanes, lights, 1.0f, packed_.data(), lights,
              answers_.data(), lights, 0.0f, right_sides_.data(), lanes);
  for (size_t i = 0; i < lanes; ++i)
    if (!rows[i].entries.empty()) reduce(rows[i], i);
}

// H of some columns from their weighted responses.
void LightRefit::multiply(const float* responses, size_t columns) {
  const int n = static_cast<int>(columns), lights = static_cast<int>(training_.count);
  gram_columns_ = columns;
  gram_.assign(columns * columns, 0.0f);
  cblas_ssyrk(CblasRowMajor, CblasLower, CblasNoTrans, n, lights, 1.0f, responses, lights, 0.0f, gram_.data(),
              n);
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
  fixed_.clear();
  if (row.entries.size() > largest_fit_) fix_lightest(row, lane);
  const size_t target = row.target - fixed_.size();
  set_up(row, lane);
  const size_t step = (row.entries.size() - target + elimination_rounds - 1) / elimination_rounds;
  solve();
  while (left_.size() > target) {
    drop_least(std::min(step, left_.size() - target));
    solve();
  }
  row.entries.clear();
  for (size_t p = 0; p < left_.size(); ++p)
    row.entries.push_back({columns_[left_[p]], static_cast<float>(solution_[p])});
  row.entries.insert(row.entries.end(), fixed_.begin(), fixed_.end());
  if (!fixed_.empty()) std::ranges::sort(row.entries, {}, &SparseEntry::column);
}

// Takes out of the row what does not fit: first what the target does not want, then what keeps its value.
void LightRefit::fix_lightest(RefitRow& row, size_t lane) {
  const int lights = static_cast<int>(training_.count);
  const auto responses = [&](const SparseEntry& e) {
    const auto column = std::lower_bound(columns_.begin(), columns_.end(), e.column);
    return packed_.data() + (column - columns_.begin()) * lights;
  };
  std::vector<std::pair<float, SparseEntry>> weighed;
  for (const SparseEntry& e : row.entries) {
    const float* r = responses(e);
    weighed.emplace_back(e.value * e.value * cblas_sdot(lights, r, 1, r, 1), e);
  }
  std::ranges::sort(weighed, [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second.column < b.second.column;
  });
  weighed.resize(std::max(row.target, largest_fit_));
  residual_.assign(answers_.data() + lane * training_.count, answers_.data() + (lane + 1) * training_.count);
  row.entries.clear();
  for (const auto& [weight, e] : weighed) {
    if (row.entries.size() < largest_fit_) {
      row.entries.push_back(e);
      continue;
    }
    fixed_.push_back(e);
    cblas_saxpy(lights, -e.value, responses(e), 1, residual_.data(), 1);
  }
  std::ranges::sort(row.entries, {}, &SparseEntry::column);
}

// Places of the row's candidates among the tile's columns, their values, right sides and ridge.
void LightRefit::set_up(const RefitRow& row, size_t lane) {
  left_.clear(), prior_.clear(), right_.clear();
  size_t k = 0;
  for (const SparseEntry& e : row.entries) {  // ascending, too
    while (columns_[k] != e.column) ++k;
    left_.push_back(k);
    prior_.push_back(static_cast<double>(e.value));
    right_.push_back(static_cast<double>(right_sides_[k * lanes + lane]));
  }
  if (columns_.size() <= largest_fit_)
    place_ = left_;
  else
    multiply_row();
  set_ridge();
}

// H of the row alone, and its right sides where other entries keep their values.
void LightRefit::multiply_row() {
  const size_t lights = training_.count, size = left_.size();
  row_responses_.resize(size * lights);
  place_.resize(size);
  for (size_t p = 0; p < size; ++p) {
    std::copy_n(packed_.data() + left_[p] * lights, lights, row_responses_.data() + p * lights);
    place_[p] = p;
    if (!fixed_.empty())
      right_[p] = static_cast<double>(
          cblas_sdot(static_cast<int>(lights), row_responses_.data() + p * lights, 1, residual_.data(), 1));
  }
  multiply(row_responses_.data(), size);
}

// Where no training light excites any of the candidates, the values stay and the largest are kept.
void LightRefit::set_ridge() {
  stiffness_.clear();
  double trace = 0.0;
  for (size_t p = 0; p < left_.size(); ++p) {
    stiffness_.push_back(static_cast<double>(gram(p, p)));
    trace += stiffness_.back();
  }
  const double floor = stiffness_floor * trace / static_cast<double>(left_.size());
  for (double& s : stiffness_) s = trace > 0.0 ? ridge_ * (s + floor) : 1.0;
}

// The normal equations (H_SS + M) w = G_S W^2 y + M c_S, M the ridge, of what is left, in double; leaves the
// Cholesky factor in matrix_.
void LightRefit::solve() {
  const size_t size = left_.size();
  matrix_.resize(size * size);
  solution_.resize(size);
  for (size_t p = 0; p < size; ++p) {
    for (size_t q = 0; q <= p; ++q) matrix_[p * size + q] = static_cast<double>(gram(p, q));
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
    left_[kept] = left_[p], place_[kept] = place_[p], prior_[kept] = prior_[p];
    stiffness_[kept] = stiffness_[p], right_[kept] = right_[p];
    ++kept;
  }
  left_.resize(kept), place_.resize(kept), prior_.resize(kept), stiffness_.resize(kept), right_.resize(kept);
}

}  // namespace relight::direct_to_indirect
