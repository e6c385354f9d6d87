// Everything one invocation works on: the scene, its lighting, the view, the ray tracer, the deep frame
// buffer, the GPU context and the artefact cache. Loaded in an order that refuses bad input before anything
// slow starts.
#pragma once

#include <memory>

#include "common/gpu/context.h"
#include "common/run/artefact_cache.h"
#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "common/run/thread_limit.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"
#include "experiments/session/options.h"

namespace relight {

// One moment of a lighting.
struct ChosenLighting {
  std::string preset;  // or file
  std::string name;    // preset; with "@SECONDS" if the lighting moves
  double time = 0.0;   // [s]
  LightingState animated;
};

class Session {
 public:
  enum class Gpu { needed, not_needed };
  // Throws UsageError for an unknown scene, preset, view or GPU name; Error if a file is broken or no context
  // opens.
  Session(const SessionOptions& options, Gpu gpu);

  const Scene& scene() const { return scene_; }
  const LightingState& lighting() const { return lighting_; }  // standing still, at the time asked for
  // Does light from an environment reach the scene at that time?
  bool has_environment() const { return !lighting_.environment_or(scene_.environment).black(); }
  const LightingState& animated_lighting() const { return chosen_.animated; }
  // As `--lights` would name it: with "@SECONDS" if it moves.
  const std::string& lighting_name() const { return chosen_.name; }
  const std::string& lighting_preset() const { return chosen_.preset; }  // or file
  const RayTracer& tracer() const { return *tracer_; }
  RayTracer& tracer() { return *tracer_; }
  const DeepFrameBuffer& buffer() const { return buffer_; }
  ArtefactCache& cache() { return cache_; }
  Progress& progress() { return progress_; }
  gpu::Context* gpu() { return gpu_.get(); }        // null if not needed
  const StageLog& setup() const { return setup_; }  // loading, BVH, deep frame buffer
  const SessionOptions& options() const { return options_; }

 private:
  SessionOptions options_;
  ThreadLimit threads_;
  StageLog setup_;
  Scene scene_;
  ChosenLighting chosen_;
  LightingState lighting_;
  std::unique_ptr<gpu::Context> gpu_;
  std::unique_ptr<RayTracer> tracer_;
  DeepFrameBuffer buffer_;
  ArtefactCache cache_;
  Progress progress_;
};

// The scene called `name`; UsageError listing the built-in names if it is neither one of them nor a file.
Scene load_named_scene(const std::string& name);

// The preset to use when `wanted` may be empty; UsageError listing the presets if there is no obvious one.
std::string choose_lighting(const Scene& scene, const std::string& wanted);

// The lighting of that preset or file, checked; UsageError listing the presets if it is neither.
LightingState load_named_lighting(const Scene& scene, const std::string& name);

// `wanted`: "spot", "sweep@0.5", or empty as in choose_lighting(); `time`: of a lighting that is named
// without one. UsageError if both say a time, or there is one and nothing moves.
ChosenLighting choose_lights(const Scene& scene, const std::string& wanted, double time = 0.0);

// The scene's camera or view that `--view` names, e.g. "640x480" or "gallery:640x480". UsageError listing the
// views.
View choose_view(const Scene& scene, const std::string& wanted);

// What decides the picture beside the scene's content and the size: camera and lights, each by a hash.
std::string view_hash(const View& view);
std::string lighting_hash(const LightingState& standing_still);

ArtefactCache open_cache(const SessionOptions& options);

}  // namespace relight
