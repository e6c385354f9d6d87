// Everything that a path-traced picture has gathered so far, and its form in a checkpoint file. A run that is
// resumed from its state gives the same bits as one that was never interrupted, because every batch is a
// function of seed, place and number.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace relight {

// Mean and sum of squared deviations of a pixel's batch means (Welford's update), and the brightest batch.
struct PixelStatistics {
  glm::dvec3 mean{0.0}, squares{0.0};
  double brightest = 0.0;  // largest batch mean of the mean channel
  void add(const glm::dvec3& batch_mean, int number_of_batches) {
    const glm::dvec3 before = batch_mean - mean;
    mean += before / static_cast<double>(number_of_batches);
    squares += before * (batch_mean - mean);
    brightest = std::max(brightest, (batch_mean.x + batch_mean.y + batch_mean.z) / 3.0);
  }
  // Variance of the mean after `batches` >= 2.
  glm::dvec3 variance(int batches) const {
    const auto n = static_cast<double>(batches);
    return squares / (n * (n - 1.0));
  }
  // A rare bright sample dominates: without its brightest batch the mean would be less than half. Such pixels
  // are neither converged nor is their variance to be trusted. Needs 8 batches to tell.
  bool is_firefly(int batches) const {
    const double sum = (mean.x + mean.y + mean.z) / 3.0 * batches;
    return batches >= 8 && sum > 0.0 && brightest > 0.5 * sum;
  }
};

struct PathTracerState {
  int batches = 0;
  int64_t rays = 0, non_finite = 0;
  double seconds = 0.0;    // spent on it, all sessions together
  std::vector<int> paths;  // a tile: paths from each visible point for each set of light vertices
  std::vector<PixelStatistics> pixels;  // all classes together
  std::vector<PixelStatistics> layers;  // pixels x classes; empty if classes are not told apart
};

// Written to a temporary file, then renamed. `key` says in words what the state belongs to. Throws Error
// naming the file.
void save_state(const std::filesystem::path& file, const std::string& key, const PathTracerState& state);
// Nothing if the file is missing. Throws Error naming the file if it is damaged or belongs to another key:
// a checkpoint is never overwritten by a different run without a word.
std::optional<PathTracerState> load_state(const std::filesystem::path& file, const std::string& key);

}  // namespace relight
