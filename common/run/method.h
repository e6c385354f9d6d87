// What a relighting method is, as the experiments see it: knobs, declared light paths, a precompute and a
// relight. A method lives in its own folder under methods/ and is registered by one line in
// experiments/method_list.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/image/image.h"
#include "common/run/effects.h"
#include "common/run/error_stages.h"
#include "common/run/knobs.h"
#include "common/run/light_paths.h"
#include "common/run/progress.h"
#include "common/run/stage_log.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/scene/scene.h"

namespace relight {

class RayTracer;
class ArtefactCache;
namespace gpu {
class Context;
}

// Everything a method may use to precompute. All references outlive the Prepared object.
struct PrepareContext {
  const Scene& scene;
  const RayTracer& tracer;
  const DeepFrameBuffer& buffer;
  const KnobValues& knobs;
  uint64_t seed;
  gpu::Context& gpu;  // current on the calling thread
  ArtefactCache& cache;
  Progress& progress;
  StageLog& log;  // precompute stages
  // Where a method may keep what is the same for many settings (a gather cloud), so that the settings of one
  // invocation share it; null: nowhere.
  ArtefactCache* parts = nullptr;
  // The first lighting that will be asked for: what it lacks altogether need not be prepared for; null: not
  // known.
  const LightingState* lighting = nullptr;

  // Does light from an environment count, as far as is known?
  bool has_environment() const {
    return !(lighting ? lighting->environment_or(scene.environment) : scene.environment).black();
  }
};

// Result of one relight; all images have the view's size.
struct Relit {
  Image direct;    // box-filtered over the 2x2 sub-pixels
  Image indirect;  // likewise, after reconstruction
  Image total;     // direct + indirect
};

// From two images of one size.
inline Relit with_total(Image direct, Image indirect) {
  Relit relit{std::move(direct), std::move(indirect), {}};
  relit.total = relit.direct;
  for (size_t i = 0; i < relit.total.pixels.size(); ++i) relit.total.pixels[i] += relit.indirect.pixels[i];
  return relit;
}

class Prepared {
 public:
  virtual ~Prepared() = default;
  // Relights under a lighting. The result does not depend on earlier lightings, except by the rounding of
  // float sums in another order; the time may: a method may keep the light of lamps that don't change from
  // call to call. Logs relight stages.
  virtual Relit relight(const LightingState& lighting, StageLog& log) = 0;
  // Drops whatever was kept of earlier lightings: the next relight costs what the first one did. Timing calls
  // it before every repeat, or it would report the time of doing nothing.
  virtual void forget() {}
};

class Method {
 public:
  virtual ~Method() = default;
  virtual std::string name() const = 0;
  virtual std::string summary() const = 0;  // one sentence
  virtual std::string paper() const = 0;    // authors, title, year
  virtual KnobTable knobs() const = 0;
  // Besides "paper", the defaults.
  virtual std::vector<KnobPreset> presets() const { return {}; }
  virtual LightPaths light_paths(const KnobValues& knobs) const = 0;
  // Do the same settings give the same picture and counters, whatever the machine's speed? False for a budget
  // of time.
  virtual bool repeatable(const KnobValues&) const { return true; }
  // The approximations that these settings consist of; see error_stages.h.
  virtual ErrorStages error_stages(const KnobValues&) const { return {}; }
  // What of a scene it can leave out; see effects.h.
  virtual std::vector<Effect> effects(const KnobValues&) const { return {}; }
  virtual std::unique_ptr<Prepared> prepare(const PrepareContext& context) const = 0;
};

}  // namespace relight
