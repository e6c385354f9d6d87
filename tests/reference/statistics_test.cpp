// Determinism, honest variance, limits and refusals.
#include <chrono>
#include <cstring>

#include <tbb/global_control.h>

#include "common/run/error.h"
#include "tests/reference/render.h"

namespace relight::tiny {
namespace {

bool same_bits(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

const LightingState two_lights =
    lighting({omni({0.3f, 0.6f, 0.4f}), spot({0.2f, 0.9f, 0.3f}, {0.3f, -1.0f, 0.1f}, 10.0f, 20.0f)});

// Red if: random numbers or sums depend on threads or the order of tiles (tried: pixels numbered in the order
// in which they are begun).
TEST(PathTracer, GivesTheSameBitsForOneAndManyThreads) {
  const Rendering render(room(2.0f, glm::vec3(0.0f), true), 50, 37);
  const PathTracerSettings s = settings(Estimator::light_vertex, 16, 4, bounces(1, 3, true));
  PathTracerResult one;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    one = render(two_lights, s);
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
  const PathTracerResult many = render(two_lights, s);
  EXPECT_TRUE(same_bits(one.indirect, many.indirect));
  EXPECT_TRUE(same_bits(one.indirect_variance, many.indirect_variance));
  EXPECT_TRUE(same_bits(one.direct, many.direct));
  EXPECT_EQ(one.rays, many.rays);
}

// Red if (tried): the seed is ignored.
TEST(PathTracer, GivesOtherNoiseForAnotherSeed) {
  const Rendering render(room(), 8, 6);
  const PathTracerResult a = render(two_lights, settings(Estimator::next_event, 16, 2, {}, 1));
  const PathTracerResult b = render(two_lights, settings(Estimator::next_event, 16, 2, {}, 2));
  EXPECT_FALSE(same_bits(a.indirect, b.indirect));
}

// Over 48 seeds the spread of the results must equal the variance they claim. Red if (each tried): the
// variance lacks a factor (n for n-1, batches), or batches share random numbers.
TEST(PathTracer, PredictsItsOwnVariance) {
  const Rendering render(room(), 12, 9);
  for (int samples_per_batch : {1, 3, 4, 16}) {
    const int seeds = 48, batches = 4;
    std::vector<Image> images;
    double predicted = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      const PathTracerResult result = render(lighting({omni({0.3f, 0.6f, 0.4f})}),
                                             settings(Estimator::light_vertex, samples_per_batch * batches,
                                                      batches, {}, static_cast<uint64_t>(seed)));
      images.push_back(result.indirect);
      predicted += mean_of(result.indirect_variance).x / seeds;
    }
    double spread = 0;
    for (size_t i = 0; i < images[0].pixels.size(); ++i) {
      double mean = 0, squares = 0;
      for (const Image& image : images) mean += static_cast<double>(image.pixels[i].x) / seeds;
      for (const Image& image : images) squares += std::pow(static_cast<double>(image.pixels[i].x) - mean, 2);
      spread += squares / (seeds - 1) / static_cast<double>(images[0].pixels.size());
    }
    // 108 pixels x 47 degrees of freedom, heavier tails than normal: about 4 % standard error.
    EXPECT_NEAR(predicted / spread, 1.0, 0.15) << samples_per_batch << " samples a batch";
  }
}

// Red if (tried: without the random rotation): batches of fewer than four samples favour some sub-pixels. The
// left sub-pixels of each pixel see nothing.
TEST(PathTracer, FewSamplesABatchAreUnbiasedOverSubPixels) {
  const Rendering render(room(), 8, 6);
  const LightingState lights = lighting({omni({0.3f, 0.6f, 0.4f})});
  const PathTracerResult few = render(lights, settings(Estimator::light_vertex, 3 * 512, 512, {}, 3));
  const PathTracerResult many = render(lights, settings(Estimator::light_vertex, 16 * 64, 64, {}, 4));
  expect_same_mean(ZTest(few.indirect, few.indirect_variance, many.indirect, many.indirect_variance));
}

// Red if (both tried): one sequence restarts at each batch (identical batches), or each batch has a
// scrambling of its own.
TEST(PathTracer, OneSequenceGivesLessNoiseThanBatchesOfOne) {
  const Rendering render(room(), 12, 9);
  const LightingState lights = lighting({omni({0.3f, 0.6f, 0.4f})});
  PathTracerSettings s = settings(Estimator::light_vertex, 64, 64);
  const Image truth = render(lights, settings(Estimator::light_vertex, 4096, 4, {}, 9)).indirect;
  const auto error = [&](const Image& image) {
    double sum = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i)
      sum += glm::dot(image.pixels[i] - truth.pixels[i], image.pixels[i] - truth.pixels[i]);
    return sum;
  };
  const double independent = error(render(lights, s).indirect);
  s.one_sequence = true;
  const PathTracerResult sequence = render(lights, s);
  EXPECT_LT(error(sequence.indirect), 0.8 * independent);
  EXPECT_TRUE(sequence.indirect_variance.pixels.empty());
}

// Red if (both tried): the limit is ignored, or ends a run after its first batch.
TEST(PathTracer, StopsBeforeTheBatchThatWouldExceedTheTimeLimit) {
  const Rendering render(room(), 64, 48);
  PathTracerSettings s = settings(Estimator::light_vertex, 1 << 20, 1 << 18);
  s.time_limit_s = 0.3;
  const auto start = std::chrono::steady_clock::now();
  const PathTracerResult result = render(two_lights, s);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LT(seconds, 1.5);
  EXPECT_GT(result.batches, 2);
  EXPECT_EQ(result.samples_per_pixel, 4 * result.batches);
  s.time_limit_s = 1e-9;
  EXPECT_EQ(render(two_lights, s).batches, 2);
}

// Red if lights that are absent, dark, or a view of nothing make NaN or a crash (tried: the relative error of
// a black picture is 0/0).
TEST(PathTracer, AnswersBlackWhereThereIsNoLightOrNoSurface) {
  const Rendering render(room(), 8, 6);
  LightingState dark = lighting({omni({0.3f, 0.6f, 0.4f}, glm::vec3(0.0f))});
  for (const LightingState& lights : {LightingState{}, dark}) {
    const PathTracerResult result =
        render(lights, settings(Estimator::light_vertex, 4, 2, bounces(1, 3, true)));
    EXPECT_EQ(mean_of(result.total()), glm::dvec3(0.0));
    EXPECT_EQ(result.non_finite, 0);
    EXPECT_EQ(result.relative_standard_error, 0.0);
  }
  Scene away = room();
  away.camera.eye = {0, 0, 90};
  away.camera.target = {0, 0, 180};
  const Rendering nothing(std::move(away), 8, 6);
  EXPECT_EQ(mean_of(nothing(two_lights, settings(Estimator::light_vertex, 4, 2)).total()), glm::dvec3(0.0));
}

// Red if (tried): a sample that isn't finite reaches the mean unseen.
TEST(PathTracer, CountsSamplesThatAreNotFiniteAndReplacesThem) {
  Scene scene = room();
  scene.materials[0].diffuse.y = std::numeric_limits<float>::quiet_NaN();
  const Rendering render(std::move(scene), 8, 6);
  const PathTracerResult result = render(two_lights, settings(Estimator::light_vertex, 4, 2));
  EXPECT_GT(result.non_finite, 0);
  for (const glm::vec3& p : result.total().pixels) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
}

TEST(PathTracer, RefusesSettingsOutOfRange) {
  const Rendering render(room(), 8, 6);
  const PathTracerSettings good = settings(Estimator::next_event, 4, 2);
  const auto refused = [&](auto change) {
    PathTracerSettings s = good;
    change(s);
    EXPECT_THROW(render(two_lights, s), Error);
  };
  refused([](auto& s) { s.batches = 1; });
  refused([](auto& s) { s.samples_per_pixel = 1; });
  refused([](auto& s) { s.paths.min_bounces = -1; });
  refused([](auto& s) { s.paths.max_bounces = -1; });
  refused([](auto& s) { s.time_limit_s = std::numeric_limits<double>::quiet_NaN(); });
}

}  // namespace
}  // namespace relight::tiny
