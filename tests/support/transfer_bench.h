// Direct-to-indirect transfer on a small view of any scene, for tests that relight it again and again.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/gpu/context.h"
#include "common/run/artefact_cache.h"
#include "common/tracing/ray_tracer.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "tests/support/image_difference.h"

namespace relight::test {

class TransferBench {
 public:
  using Knobs = std::vector<std::pair<std::string, std::string>>;

  explicit TransferBench(Scene s, int width = 40, int height = 30)
      : scene(std::move(s)),
        tracer(scene),
        buffer(make_deep_frame_buffer(scene, tracer, {scene.camera, width, height})) {}

  ~TransferBench() { std::filesystem::remove_all(folder); }
  TransferBench(const TransferBench&) = delete;
  TransferBench& operator=(const TransferBench&) = delete;

  // 1024 gather samples and a coarse cut of their hierarchy, which is fast, unless the knobs say otherwise.
  std::unique_ptr<Prepared> prepare(const Knobs& knobs) {
    KnobValues values(method->knobs());
    values.set("gather_samples", "1024");
    values.set("link_threshold", "2");
    for (const auto& [name, value] : knobs) values.set(name, value);
    prepare_log = {};
    return method->prepare(
        {scene, tracer, buffer, values, seed, *context, cache, progress, prepare_log, parts, lighting});
  }

  Scene scene;
  RayTracer tracer;
  DeepFrameBuffer buffer;
  std::unique_ptr<gpu::Context> context = gpu::Context::create("osmesa");
  std::unique_ptr<Method> method = make_direct_to_indirect();
  // One precompute for all devices and relight knobs.
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("relight_transfer_bench_" + std::to_string(::getpid()));
  ArtefactCache cache{folder, true};
  Progress progress{true};
  uint64_t seed = 1;
  StageLog prepare_log;  // of the last prepare
  // See PrepareContext.
  ArtefactCache* parts = nullptr;
  const LightingState* lighting = nullptr;
};

}  // namespace relight::test
