// Clustered gather on a small view of any scene, for tests that relight it again and again.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/gpu/context.h"
#include "common/run/artefact_cache.h"
#include "common/tracing/ray_tracer.h"
#include "methods/clustered_gather/clustered_gather.h"
#include "tests/support/image_difference.h"

namespace relight::test {

using Knobs = std::vector<std::pair<std::string, std::string>>;

struct GatherBench {
  explicit GatherBench(Scene s, int width = 40, int height = 30)
      : scene(std::move(s)), buffer(make_deep_frame_buffer(scene, tracer, {scene.camera, width, height})) {}
  Scene scene;
  RayTracer tracer{scene};
  DeepFrameBuffer buffer;
  std::unique_ptr<gpu::Context> context = gpu::Context::create("osmesa");
  std::unique_ptr<Method> method = make_clustered_gather();
  ArtefactCache cache = ArtefactCache::in_memory();
  Progress progress{true};
  StageLog precompute_log, relight_log;  // of the last calls

  // Few clusters and directions unless the knobs say otherwise.
  std::unique_ptr<Prepared> prepare(const Knobs& knobs) {
    KnobValues values(method->knobs());
    for (const auto& [name, value] :
         Knobs{{"view_clusters", "200"}, {"directions", "100"}, {"gather_clusters", "16"}})
      values.set(name, value);
    for (const auto& [name, value] : knobs) values.set(name, value);
    precompute_log = {};
    return method->prepare({scene, tracer, buffer, values, 1, *context, cache, progress, precompute_log});
  }
  Relit relight(const Knobs& knobs, const LightingState& lighting) {
    relight_log = {};
    return prepare(knobs)->relight(lighting, relight_log);
  }
};

}  // namespace relight::test
