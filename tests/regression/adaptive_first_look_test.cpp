// From 128 samples a pixel on, a first look gives noisy tiles more paths (reference/batch_renderer.h). The
// stored pictures are made of single-sequence renders, which have none; here one render that has it is
// compared with them.
#include <algorithm>

#include <gtest/gtest.h>

#include "failure_report.h"
#include "reference/path_tracer_state.h"
#include "stored_session.h"
#include "tests/cli/program.h"

namespace relight::test {
namespace {

constexpr int batches = 32, samples = 128;

struct AdaptiveRender {
  PathTracerResult result;
  std::vector<Image> by_batch;  // indirect light of each batch alone
  std::vector<int> paths;       // of each tile
};

// The picture of batch n from the means of n and of n - 1 batches.
Image last_batch(const PathTracerState& now, const PathTracerState& before, const View& view) {
  Image image(view.width, view.height);
  const double n = now.batches;
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = glm::vec3(n * now.pixels[i].mean - (n - 1.0) * before.pixels[i].mean);
  return image;
}

// The path tracer gives no batches away, but its checkpoint after each batch holds their mean: the one that
// the batch before has left is read when the next is over.
AdaptiveRender render_adaptively(StoredSession& scene, uint64_t seed) {
  const TemporaryFolder folder;
  PathTracerSettings settings;
  settings.paths = scene.reference().paths;
  settings.samples_per_pixel = samples, settings.batches = batches, settings.seed = seed;
  settings.checkpoint = {folder.path() / "state", "", 0.0};
  const View& view = scene.session().buffer().view;
  PathTracerState before;
  before.pixels.resize(static_cast<size_t>(view.width) * static_cast<size_t>(view.height));
  AdaptiveRender render;
  const auto read = [&] {
    const auto now = load_state(settings.checkpoint.file, "");
    if (!now || now->batches == before.batches) return;
    render.by_batch.push_back(last_batch(*now, before, view));
    before = *now;
  };
  settings.on_batch = [&](const ConvergencePoint&) { read(); };
  StageLog log;
  render.result = path_trace(scene.session().tracer(), scene.session().buffer(), scene.session().lighting(),
                             settings, scene.session().progress(), log);
  read();
  render.paths = before.paths;
  return render;
}

// Red if a tile's connections are not scaled by its number of paths (tried: 11 % too dark), or the mean is
// taken over the usual number.
TEST(AdaptiveFirstLook, RenderAgreesWithTheStoredPicture) {
  StoredSession scene("cornell_omni");
  AdaptiveRender render = render_adaptively(scene, 1);
  ASSERT_EQ(render.by_batch.size(), static_cast<size_t>(batches));
  const auto most = *std::max_element(render.paths.begin(), render.paths.end());
  EXPECT_GE(most, 2) << "no tile was given more paths: nothing is tested";
  PictureStatistics fresh = statistics_of(render.by_batch);
  for (size_t i = 0; i < fresh.pixels.mean.pixels.size(); ++i)
    ASSERT_NEAR(fresh.pixels.mean.pixels[i].y, render.result.indirect.pixels[i].y,
                1e-5f * render.result.indirect.pixels[i].y)
        << "these are not the batches of the picture";
  fresh.direct = render.result.direct;
  fresh.samples_per_pixel = render.result.samples_per_pixel;
  fresh.non_finite = render.result.non_finite;
  const Decision decision = compare_pictures(fresh, scene.stored().picture);
  EXPECT_TRUE(decision.same()) << report_failure(failures_folder() / "adaptive_first_look", "cornell_omni",
                                                 fresh, scene.stored().picture, decision, 1.0f);
  std::printf("up to %d paths a sample\n%s", most, decision.to_string().c_str());
  EXPECT_FALSE(compare_pictures(brighter(fresh, 1.02), scene.stored().picture).same()) << "2 % too bright";
}

}  // namespace
}  // namespace relight::test
