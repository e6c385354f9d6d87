// What the stored reference depends on, and its bytes.
#include <functional>

#include <gtest/gtest.h>

#include "experiments/compare/reference_images.h"
#include "experiments/compare/result_bytes.h"
#include "program.h"

namespace relight::test {
namespace {

SessionOptions options() {
  SessionOptions o;
  o.scene = "cornell";
  o.lights = "spot";
  o.view = "8x6";
  o.quiet = true;
  o.no_cache = true;
  return o;
}

std::string key(const SessionOptions& o, const PathTracerSettings& settings = {}) {
  Session session(o, Session::Gpu::not_needed);
  return reference_key(session, settings);
}

// Red if the key forgets something that changes the picture: a stale reference would then be compared in
// silence.
TEST(ReferenceKey, ChangesWithEverythingThatChangesThePicture) {
  const std::string start = key(options());
  SessionOptions o = options();
  o.scene = "cornell:boxes=1";
  EXPECT_NE(key(o), start) << "scene content";
  o = options();
  o.view = "8x7";
  EXPECT_NE(key(o), start) << "view";
  o = options();
  o.lights = "omni";
  EXPECT_NE(key(o), start) << "lights";
  const std::vector<std::function<void(PathTracerSettings&)>> changes = {
      [](auto& s) { s.paths.max_bounces = 2; },
      [](auto& s) { s.paths.min_bounces = 0; },
      [](auto& s) { s.paths.glossy_at_eye = true; },
      [](auto& s) { s.paths.glossy_interior = true; },
      [](auto& s) { s.paths.environment = true; },
      [](auto& s) { s.paths.emission = true; },
      [](auto& s) { s.samples_per_pixel = 7; },
      [](auto& s) { s.batches = 3; },
      [](auto& s) { s.seed = 5; },
      [](auto& s) { s.estimator = Estimator::next_event; }};
  for (size_t i = 0; i < changes.size(); ++i) {
    PathTracerSettings settings;
    changes[i](settings);
    EXPECT_NE(key(options(), settings), start) << "change " << i;
    EXPECT_FALSE(i < 6 && same_paths(settings.paths, LightPaths{})) << "change " << i;
  }
}

// Red if the number of threads, which changes nothing, costs a new reference.
TEST(ReferenceKey, DoesNotDependOnThreads) {
  SessionOptions o = options();
  o.threads = 1;
  EXPECT_EQ(key(o), key(options()));
}

// Red if an image is dropped or two are swapped in the stored bytes.
TEST(ResultBytes, ComeBackAsTheyWere) {
  PathTracerResult result;
  result.direct = Image(2, 3, glm::vec3(1, 2, 3));
  result.indirect = Image(2, 3, glm::vec3(4, 5, 6));
  result.indirect_variance = Image(2, 3, glm::vec3(7, 8, 9));
  result.samples_per_pixel = 64, result.batches = 4, result.rays = 1234567890123, result.non_finite = 2;
  const auto back = result_from_bytes(to_bytes(result), 2, 3);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->direct.pixels, result.direct.pixels);
  EXPECT_EQ(back->indirect.pixels, result.indirect.pixels);
  EXPECT_EQ(back->indirect_variance.pixels, result.indirect_variance.pixels);
  EXPECT_EQ(back->rays, result.rays);
  EXPECT_EQ(back->non_finite, 2);
  EXPECT_EQ(back->batches, 4);
}

// Red if bytes of another size are read as an image (3x2 and 2x3 have equally many pixels).
TEST(ResultBytes, OfAnotherSizeAreRefused) {
  PathTracerResult result;
  result.direct = result.indirect = result.indirect_variance = Image(2, 3);
  auto bytes = to_bytes(result);
  EXPECT_FALSE(result_from_bytes(bytes, 3, 2));
  bytes.pop_back();
  EXPECT_FALSE(result_from_bytes(bytes, 2, 3));
  EXPECT_FALSE(result_from_bytes({}, 2, 3));
}

}  // namespace
}  // namespace relight::test
