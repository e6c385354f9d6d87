// A few pixels computed alone, for explain-error: they are those of the whole picture, and cost their share
// of it.
#include <gtest/gtest.h>

#include <cstring>

#include "common/gpu/context.h"
#include "common/run/artefact_cache.h"
#include "common/sampling/pixel_subset.h"
#include "common/tracing/ray_tracer.h"
#include "methods/clustered_gather/clustered_gather.h"
#include "tests/support/tiny_scenes.h"

namespace relight {
namespace {

using Knobs = std::vector<std::pair<std::string, std::string>>;

struct PixelBench {
  Scene scene = tiny::room(2.0f, glm::vec3(0.0f), true);
  RayTracer tracer{scene};
  DeepFrameBuffer buffer = make_deep_frame_buffer(scene, tracer, {scene.camera, 62, 45});
  std::unique_ptr<gpu::Context> context = gpu::Context::create("osmesa");
  std::unique_ptr<Method> method = make_clustered_gather();
  ArtefactCache cache = ArtefactCache::in_memory();
  Progress progress{true};
  StageLog log;

  Image total(const Knobs& knobs) {
    KnobValues values(method->knobs());
    for (const auto& [name, value] : knobs) values.set(name, value);
    log = {};
    StageLog relight_log;
    return method->prepare({scene, tracer, buffer, values, 1, *context, cache, progress, log})
        ->relight(tiny::lighting({tiny::omni({0.2f, 0.4f, 0.7f})}), relight_log)
        .total;
  }
};

// Red if a view cluster that a wanted pixel takes light from is left out (tried: only those that the wanted
// pixels themselves link to, without the 3x3 upsampling; only each pixel's first link), or the cache takes
// the data of some pixels for those of all (tried: pixels left out of the key).
TEST(ClusteredGatherPixelsAlone, AreThoseOfTheWholePictureAndCostLess) {
  PixelBench bench;
  const PixelSubset subset = choose_pixels(62, 45, 128, glm::ivec2(4), 1);
  const Knobs clustered = {
      {"device", "cpu"}, {"view_clusters", "300"}, {"directions", "64"}, {"gather_clusters", "12"}};
  const Knobs exact = {{"device", "cpu"},
                       {"view_clusters", "0"},
                       {"neighbours", "1"},
                       {"directions", "32"},
                       {"gather_clusters", "0"}};
  for (const Knobs& knobs : {clustered, exact}) {
    bench.buffer.wanted.clear();
    const Image whole = compact(bench.total(knobs), subset);
    const int64_t rays = bench.log.counters().at("gather_rays");
    bench.buffer.wanted = pixel_mask(subset);
    const Image alone = compact(bench.total(knobs), subset);
    EXPECT_EQ(std::memcmp(whole.pixels.data(), alone.pixels.data(), whole.pixels.size() * sizeof(glm::vec3)),
              0);
    EXPECT_LT(bench.log.counters().at("gather_rays"), rays * 3 / 4);
  }
}

}  // namespace
}  // namespace relight
