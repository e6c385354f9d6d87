#include "experiments/stored_references/picture_statistics.h"

#include <algorithm>
#include <cmath>

#include "common/run/error.h"
#include "common/sampling/random.h"
#include "reference/path_tracer_state.h"

namespace relight {

namespace {

// Keeps the batches' seeds apart from seeds that people type.
constexpr uint64_t batch_stream = 0x73746f7265642d62;

// The statistics of images of one size.
class Accumulator {
 public:
  void add(const Image& image) {
    if (values_.empty()) size_ = Image(image.width, image.height), values_.resize(image.pixels.size());
    ++count_;
    for (size_t i = 0; i < values_.size(); ++i) values_[i].add(glm::dvec3(image.pixels[i]), count_);
  }
  Estimate estimate() const {
    Estimate result{size_, size_};
    for (size_t i = 0; i < values_.size(); ++i) {
      result.mean.pixels[i] = glm::vec3(values_[i].mean);
      result.variance.pixels[i] = glm::vec3(values_[i].variance(count_));
    }
    return result;
  }
  int64_t fireflies() const {
    return std::count_if(values_.begin(), values_.end(),
                         [&](const PixelStatistics& s) { return s.is_firefly(count_); });
  }

 private:
  Image size_;
  std::vector<PixelStatistics> values_;
  int count_ = 0;
};

PathTracerSettings batch_settings(const BatchPlan& plan, int batch) {
  PathTracerSettings settings;
  settings.paths = plan.paths;
  settings.estimator = plan.estimator;
  settings.samples_per_pixel = plan.samples_per_batch;
  settings.batches = 1;
  settings.one_sequence = true;
  settings.seed = random_bits(plan.seed, batch_stream, static_cast<uint64_t>(batch), 0);
  return settings;
}

}  // namespace

Image block_means(const Image& image, int side) {
  Image blocks((image.width + side - 1) / side, (image.height + side - 1) / side);
  for (int y = 0; y < blocks.height; ++y)
    for (int x = 0; x < blocks.width; ++x) {
      glm::dvec3 sum(0.0);
      int count = 0;
      for (int v = y * side; v < std::min((y + 1) * side, image.height); ++v)
        for (int u = x * side; u < std::min((x + 1) * side, image.width); ++u, ++count)
          sum += glm::dvec3(image.at(u, v));
      blocks.at(x, y) = glm::vec3(sum / static_cast<double>(count));
    }
  return blocks;
}

double PictureStatistics::relative_standard_error() const {
  double error = 0.0, sum = 0.0;
  for (size_t i = 0; i < direct.pixels.size(); ++i) {
    const glm::dvec3 v(pixels.variance.pixels[i]),
        m = glm::dvec3(pixels.mean.pixels[i]) + glm::dvec3(direct.pixels[i]);
    error += v.x + v.y + v.z;
    sum += glm::dot(m, m);
  }
  return sum > 0.0 ? std::sqrt(error / sum) : 0.0;
}

PictureStatistics statistics_of(const std::vector<Image>& renders) {
  if (renders.size() < 2) fail("picture statistics: {} renders; needed are at least 2", renders.size());
  Accumulator pixels, tiles, whole;
  for (const Image& image : renders) {
    pixels.add(image);
    tiles.add(block_means(image, tile_side));
    whole.add(block_means(image, std::max(image.width, image.height)));
  }
  PictureStatistics result;
  result.pixels = pixels.estimate();
  result.tiles = tiles.estimate();
  result.whole = whole.estimate();
  result.fireflies = pixels.fireflies();
  result.batches = static_cast<int>(renders.size());
  return result;
}

PictureStatistics render_statistics(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                                    const LightingState& lighting, const BatchPlan& plan,
                                    Progress& progress) {
  if (plan.batches < 2) fail("stored reference: {} batches; needed are at least 2", plan.batches);
  std::vector<PathTracerResult> renders;
  Progress quiet(true);
  progress.start("path tracing", plan.batches);
  for (int batch = 0; batch < plan.batches; ++batch) {
    StageLog log;
    renders.push_back(path_trace(tracer, buffer, lighting, batch_settings(plan, batch), quiet, log));
    progress.advance();
  }
  progress.finish();
  std::vector<Image> indirect;
  for (PathTracerResult& render : renders) indirect.push_back(std::move(render.indirect));
  PictureStatistics result = statistics_of(indirect);
  for (const PathTracerResult& render : renders) {
    result.non_finite += render.non_finite;
    result.rays += render.rays;
    result.seconds += render.seconds;
  }
  result.direct = std::move(renders.back().direct);
  result.samples_per_pixel = plan.batches * plan.samples_per_batch;
  return result;
}

}  // namespace relight
