// What is read is what was stored, and a folder that is not whole is refused.
#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "common/run/error.h"
#include "experiments/stored_references/files.h"
#include "experiments/stored_references/identity.h"
#include "tests/cli/program.h"

namespace relight::test {
namespace {

PictureStatistics gradient() {
  PictureStatistics picture;
  picture.direct = picture.pixels.mean = picture.pixels.variance = Image(10, 6);
  for (size_t i = 0; i < 60; ++i) {
    const auto v = static_cast<float>(i + 1);
    picture.direct.pixels[i] = glm::vec3(0.0f, 0.1f * v, 1000.0f / v);
    picture.pixels.mean.pixels[i] = glm::vec3(0.3f / v, 0.7f, 1e-6f * v);
    picture.pixels.variance.pixels[i] = glm::vec3(1e-9f * v, 0.0f, 3e-5f);
  }
  picture.tiles = {block_means(picture.pixels.mean, tile_side), Image(3, 2, glm::vec3(2e-7f))};
  picture.whole = {block_means(picture.pixels.mean, 10), Image(1, 1, glm::vec3(1e-8f))};
  picture.batches = 32;
  picture.samples_per_pixel = 224;
  picture.fireflies = 3;
  return picture;
}

void expect_near(const Image& a, const Image& b, float relative) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(a.pixels[i][c], b.pixels[i][c], relative * std::abs(b.pixels[i][c])) << "pixel " << i;
}

// Red if: an image is exchanged for another, rounded more than is said, or a tile at the border is wrong.
TEST(StoredFiles, GiveBackWhatWasStored) {
  const TemporaryFolder folder;
  const PictureStatistics before = gradient();
  save_stored(folder.path(), before, {{"samples_per_batch", 7}, {"scene", "x"}});
  const StoredPicture after = load_stored(folder.path());
  expect_near(after.picture.direct, before.direct, 8e-6f);
  expect_near(after.picture.pixels.mean, before.pixels.mean, 8e-6f);
  expect_near(after.picture.pixels.variance, before.pixels.variance, 2e-3f);
  expect_near(after.picture.tiles.mean, before.tiles.mean, 8e-6f);
  expect_near(after.picture.tiles.variance, before.tiles.variance, 2e-3f);
  expect_near(after.picture.whole.mean, before.whole.mean, 1e-7f);
  expect_near(after.picture.whole.variance, before.whole.variance, 1e-7f);
  EXPECT_EQ(after.picture.batches, 32);
  EXPECT_EQ(after.picture.samples_per_pixel, 224);
  EXPECT_EQ(after.picture.fireflies, 3);
  EXPECT_EQ(after.identity.at("scene"), "x");
}

TEST(StoredFiles, ThatAreMissingOrOfAnotherRunAreRefused) {
  const TemporaryFolder folder;
  const auto nothing = nlohmann::ordered_json::object();
  EXPECT_THROW(load_stored(folder.path()), Error) << "nothing there";
  save_stored(folder.path(), gradient(), nothing);
  write_exr(folder.path() / "indirect.exr", Image(10, 6, glm::vec3(1.0f)));
  EXPECT_THROW(load_stored(folder.path()), Error) << "another picture";
  save_stored(folder.path(), gradient(), nothing);
  write_exr(folder.path() / "variance.exr", Image(9, 6));
  EXPECT_THROW(load_stored(folder.path()), Error) << "another size";
  save_stored(folder.path(), gradient(), nothing);
  write_text(folder.path() / "reference.json", "{\"identity\": {}");
  EXPECT_THROW(load_stored(folder.path()), Error) << "half a file";
}

// Red if: something that changes the picture can change without being noticed.
TEST(StaleFields, NameEverythingThatChangesThePicture) {
  const StoredReference reference = stored_reference("cornell_spot");
  SessionOptions options = stored_session_options(reference);
  options.quiet = true;
  Session session(options, Session::Gpu::not_needed);
  const auto identity = picture_identity(reference, session);
  EXPECT_TRUE(stale_fields(identity, identity).empty());
  EXPECT_EQ(stale_fields({}, identity).size(), identity.size());

  options.scene = "cornell:boxes=1", options.lights = "omni";
  Session other(options, Session::Gpu::not_needed);
  EXPECT_EQ(stale_fields(identity, picture_identity(reference, other)).size(), 2u)
      << "scene_hash, lights_in_words";
  StoredReference changed = reference;
  changed.paths.max_bounces = 5, changed.samples_per_batch = 1;
  EXPECT_EQ(stale_fields(identity, picture_identity(changed, session)).size(), 2u) << "light_paths, samples";
}

}  // namespace
}  // namespace relight::test
