#include "reference/path_tracer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include <tbb/parallel_for.h>

#include "common/run/error.h"
#include "reference/direct_image.h"
#include "reference/path_sampler.h"

namespace relight {

namespace {

constexpr int tile_size = 16;  // pixels a side: large enough to share a piece of the hierarchy
constexpr uint64_t random_stream = 0x7265666572656e63;  // keeps the reference's numbers apart from all others

// Mean and sum of squared deviations of a pixel's batch means (Welford's update).
struct PixelStatistics {
  glm::dvec3 mean{0.0}, squares{0.0};
  void add(const glm::dvec3& batch_mean, int number_of_batches) {
    const glm::dvec3 before = batch_mean - mean;
    mean += before / static_cast<double>(number_of_batches);
    squares += before * (batch_mean - mean);
  }
};

// Renders batches into per-pixel statistics. Every pixel's numbers depend on seed, pixel and batch only, and
// each pixel adds its batches in order: the result is the same for any number of threads.
class BatchRenderer {
 public:
  BatchRenderer(const PathSampler& sampler, const DeepFrameBuffer& buffer, const PathTracerSettings& settings,
                int samples_per_batch)
      : sampler_(sampler),
        buffer_(buffer),
        settings_(settings),
        samples_(samples_per_batch),
        tiles_x_((buffer.view.width + tile_size - 1) / tile_size),
        tiles_y_((buffer.view.height + tile_size - 1) / tile_size),
        pixels_(buffer.indirect.size()) {}

  int tiles() const { return tiles_x_ * tiles_y_; }
  int64_t rays() const { return rays_; }
  int64_t non_finite() const { return non_finite_; }
  const std::vector<PixelStatistics>& pixels() const { return pixels_; }

  void render(int batch, Progress& progress) {
    tbb::parallel_for(0, tiles(), [&](int tile) {
      render_tile(tile, batch);
      progress.advance();
    });
  }

 private:
  void render_tile(int tile, int batch) {
    const int w = buffer_.view.width, h = buffer_.view.height;
    const int x0 = tile % tiles_x_ * tile_size, y0 = tile / tiles_x_ * tile_size;
    int64_t rays = 0, non_finite = 0;
    for (int y = y0; y < std::min(y0 + tile_size, h); ++y)
      for (int x = x0; x < std::min(x0 + tile_size, w); ++x) {
        const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(w) + static_cast<size_t>(x);
        pixels_[pixel].add(batch_mean(x, y, batch, rays, non_finite), batch + 1);
      }
    rays_ += rays;
    non_finite_ += non_finite;
  }

  // All sub-pixels share one Sobol sequence, so that the pixel as a whole is stratified; a random rotation
  // makes batches of fewer than four samples visit every sub-pixel with the same probability.
  glm::dvec3 batch_mean(int x, int y, int batch, int64_t& rays, int64_t& non_finite) const {
    const auto pixel =
        static_cast<uint64_t>(y) * static_cast<uint64_t>(buffer_.view.width) + static_cast<uint64_t>(x);
    const uint64_t scramble = random_bits(settings_.seed, random_stream, pixel,
                                          settings_.one_sequence ? 0 : static_cast<uint64_t>(batch));
    const auto first =
        settings_.one_sequence ? static_cast<uint32_t>(batch) * static_cast<uint32_t>(samples_) : 0u;
    glm::dvec3 sum(0.0);
    for (uint32_t s = first; s < first + static_cast<uint32_t>(samples_); ++s) {
      const uint32_t sub = (s + static_cast<uint32_t>(scramble >> 62)) & 3u;
      const size_t row = 2 * static_cast<size_t>(y) + sub / 2, column = 2 * static_cast<size_t>(x) + sub % 2;
      const SurfaceSample& x1 = buffer_.direct[row * 2 * static_cast<size_t>(buffer_.view.width) + column];
      if (!x1.valid) continue;
      const glm::vec3 value = sampler_.sample(x1, buffer_.view.camera.eye, {scramble, s}, rays);
      if (std::isfinite(value.x + value.y + value.z)) {
        sum += glm::dvec3(value);
      } else {
        ++non_finite;
      }
    }
    return sum / static_cast<double>(samples_);
  }

  const PathSampler& sampler_;
  const DeepFrameBuffer& buffer_;
  const PathTracerSettings& settings_;
  int samples_, tiles_x_, tiles_y_;
  std::vector<PixelStatistics> pixels_;
  std::atomic<int64_t> rays_{0}, non_finite_{0};
};

void check(const PathTracerSettings& settings, const DeepFrameBuffer& buffer) {
  const int least = settings.one_sequence ? 1 : 2;
  if (settings.batches < least)
    fail("path tracer: batches = {}; it must be at least {}", settings.batches, least);
  if (settings.samples_per_pixel < settings.batches)
    fail("path tracer: samples_per_pixel = {}; it must be at least the number of batches ({})",
         settings.samples_per_pixel, settings.batches);
  const LightPaths& paths = settings.paths;
  if (paths.min_bounces < 0 || paths.max_bounces < paths.min_bounces)
    fail("path tracer: bounces {}..{}; needed are 0 <= min <= max", paths.min_bounces, paths.max_bounces);
  if (!(settings.time_limit_s >= 0.0))
    fail("path tracer: time_limit_s = {}; it must be >= 0 (0: no limit)", settings.time_limit_s);
  const size_t pixels = static_cast<size_t>(buffer.view.width) * static_cast<size_t>(buffer.view.height);
  if (buffer.indirect.size() != pixels || buffer.direct.size() != 4 * pixels)
    fail("path tracer: the deep frame buffer does not hold {}x{} pixels", buffer.view.width,
         buffer.view.height);
}

void write_images(const std::vector<PixelStatistics>& pixels, const View& view, int batches,
                  PathTracerResult& result) {
  result.indirect = Image(view.width, view.height);
  for (size_t i = 0; i < pixels.size(); ++i) result.indirect.pixels[i] = glm::vec3(pixels[i].mean);
  if (batches < 2) return;
  result.indirect_variance = Image(view.width, view.height);
  const double n = static_cast<double>(batches);
  for (size_t i = 0; i < pixels.size(); ++i)
    result.indirect_variance.pixels[i] = glm::vec3(pixels[i].squares / (n * (n - 1.0)));
}

}  // namespace

PathTracerResult path_trace(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                            const LightingState& lighting, const PathTracerSettings& settings,
                            Progress& progress, StageLog& log) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  check(settings, buffer);
  const LightSampler lights(lighting);
  PathTracerResult result;
  {
    StageTimer timer(log, "direct");
    DirectImage direct = trace_direct(tracer, buffer, lights, settings.paths);
    result.direct = std::move(direct.image);
    result.rays = direct.rays, result.non_finite = direct.non_finite;
  }

  StageTimer timer(log, "indirect");
  const int per_batch = (settings.samples_per_pixel + settings.batches - 1) / settings.batches;
  const int least_batches = settings.one_sequence ? 1 : 2;
  const PathSampler sampler(tracer, lights, settings.paths, settings.estimator);
  BatchRenderer renderer(sampler, buffer, settings, per_batch);
  progress.start("path tracing", static_cast<int64_t>(settings.batches) * renderer.tiles());
  double longest_batch = 0.0;
  for (int batch = 0; batch < settings.batches; ++batch) {
    const double before = elapsed();
    const bool too_late = settings.time_limit_s > 0.0 && before + longest_batch > settings.time_limit_s;
    if (batch >= least_batches && too_late) break;
    renderer.render(batch, progress);
    longest_batch = std::max(longest_batch, elapsed() - before);
    result.batches = batch + 1;
  }
  progress.finish();
  result.samples_per_pixel = result.batches * per_batch;
  result.rays += renderer.rays();
  result.non_finite += renderer.non_finite();
  // Batches of one sequence aren't independent: their spread says nothing about the error.
  write_images(renderer.pixels(), buffer.view, settings.one_sequence ? 1 : result.batches, result);
  log.count("rays", result.rays);
  log.count("non_finite_samples", result.non_finite);
  if (result.non_finite > 0)
    log.warn(fmt::format("{} non-finite path samples were replaced by zero", result.non_finite));
  return result;
}

}  // namespace relight
