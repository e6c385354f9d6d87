// The hard rules: what of scene, light and view makes certain that light of some path class cannot exist.
#pragma once

#include <string>

#include "common/run/effects.h"
#include "common/sampling/deep_frame_buffer.h"
#include "common/scene/scene.h"
#include "reference/path_classes.h"

namespace relight {

struct SceneFacts {
  bool glossy_material = false;  // any material is glossy
  double glossy_pixels = 0.0;    // share of the view's pixels that show gloss in a sample
  bool environment = false;      // not black
  bool emission = false;         // any surface emits
  bool area_lights = false;      // a rectangle or disc shines
  bool local_lights = false;     // an omni, spot, directional or other light without area shines
  bool one_plane = false;        // all surfaces lie in one plane
};

SceneFacts scene_facts(const EffectSite& site);

// In words, why there is no light along such paths; empty: there may be.
std::string why_impossible(const PathClass& path_class, const SceneFacts& facts);

}  // namespace relight
