// Effects that a method can leave out, as the method itself tells them: levels from the least work to the
// most, each with the knob values that make it. The effect planner (docs/effects.md) needs nothing else to
// decide what a scene calls for; it knows no method by name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/run/error_stages.h"

namespace relight {

class RayTracer;
struct DeepFrameBuffer;
struct LightingState;
struct Scene;

struct EffectLevel {
  std::string name;  // as `--effect NAME=LEVEL` has it: "off", "3"
  KnobOverrides knobs;
};

// Where an effect is asked about: all references are of one session.
struct EffectSite {
  const Scene& scene;
  const RayTracer& tracer;
  const DeepFrameBuffer& buffer;
  const LightingState& lighting;
};

// What a level leaves out is told by the light paths that the method carries under its knobs
// (Method::light_paths): whatever the last level carries and this one doesn't is lost, and a small path trace
// measures how much that is. An effect that light paths can't tell apart (points of an area light, terms of a
// BRDF) brings `lacks` and `needless` instead.
struct Effect {
  std::string name;      // a word: "bounces"
  std::string sentence;  // what it computes
  // The last is everything the method can do; at least two. Levels must not set each other's knobs.
  std::vector<EffectLevel> levels;
  // For each level an image of the site's view: the light [radiance] that the last level has and this one
  // lacks (negative: has too much). Deterministic.
  std::function<std::vector<Image>(const EffectSite&)> lacks = nullptr;
  // In words, why the first level loses nothing here whatever the pixels show; empty: it may.
  std::function<std::string(const EffectSite&)> needless = nullptr;
};

// Levels 0 (direct light alone) to `most`, by one integer knob.
Effect bounces_effect(const std::string& knob, int most);

// Levels off and on, by one knob.
Effect switch_effect(const std::string& name, const std::string& sentence, const std::string& knob,
                     const std::string& off, const std::string& on);

}  // namespace relight
