// A method on a small view of any scene, to relight it again and again.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/gpu/context.h"
#include "common/run/artefact_cache.h"
#include "common/run/method.h"
#include "common/tracing/ray_tracer.h"

namespace relight::hard {

using KnobList = std::vector<std::pair<std::string, std::string>>;

class MethodBench {
 public:
  // `base`: knobs that make the method fast, set before those of each call.
  MethodBench(std::unique_ptr<Method> m, Scene s, KnobList base, int width = 40, int height = 30)
      : scene(std::move(s)),
        tracer(scene),
        buffer(make_deep_frame_buffer(scene, tracer, {scene.camera, width, height})),
        method(std::move(m)),
        base_(std::move(base)) {}
  MethodBench(const MethodBench&) = delete;
  MethodBench& operator=(const MethodBench&) = delete;

  // With an empty precompute_log.
  std::unique_ptr<Prepared> prepare(const KnobList& knobs) {
    values_.push_back(std::make_unique<KnobValues>(method->knobs()));
    for (const KnobList* list : {&std::as_const(base_), &knobs})
      for (const auto& [name, value] : *list) values_.back()->set(name, value);
    precompute_log = {};
    return method->prepare({scene, tracer, buffer, *values_.back(), 1, *context, cache, progress,
                            precompute_log, parts, lighting});
  }
  // Prepares, too; with an empty relight_log.
  Relit relight(const KnobList& knobs, const LightingState& lights) {
    const auto prepared = prepare(knobs);
    relight_log = {};
    return prepared->relight(lights, relight_log);
  }

  Scene scene;
  RayTracer tracer;
  DeepFrameBuffer buffer;
  std::unique_ptr<gpu::Context> context = gpu::Context::create("osmesa");
  std::unique_ptr<Method> method;
  ArtefactCache cache = ArtefactCache::in_memory();  // one precompute for settings that follow each other
  Progress progress{true};
  StageLog precompute_log, relight_log;  // of the last calls
  // See PrepareContext.
  ArtefactCache* parts = nullptr;
  const LightingState* lighting = nullptr;

 private:
  KnobList base_;
  std::vector<std::unique_ptr<KnobValues>> values_;  // a Prepared may keep a reference to its own
};

}  // namespace relight::hard
