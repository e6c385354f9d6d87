// Direct light alone: what a method that gathers indirect light from lit points comes down to with no bounce.
// No gather samples, no transfer: nothing is precomputed and only the view's own samples are lit.
#pragma once

#include <memory>
#include <string>

#include "common/run/method.h"

namespace relight {

// knobs: device (cpu, or the GPU), shadows, shadow_map_size, area_light_samples. Error, with the method's
// name, for shadows=map with device=cpu.
std::unique_ptr<Prepared> make_direct_only(const std::string& method, const PrepareContext& context);

}  // namespace relight
