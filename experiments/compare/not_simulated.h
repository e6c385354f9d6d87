// What a scene contains that a method's light paths leave out, in sentences for people: never compare a
// one-bounce method with a full solution without saying so.
#pragma once

#include <string>
#include <vector>

#include "common/run/light_paths.h"
#include "common/scene/scene.h"

namespace relight {

std::vector<std::string> not_simulated(const LightPaths& paths, const Scene& scene,
                                       const LightingState& lighting = {});

}  // namespace relight
