// Camera and lights for a mesh that comes without.
#pragma once

#include "common/scene/scene.h"

namespace relight {

// Looks at the bounding box from the front, a little from the right and above, so that its bounding sphere
// fills the picture. scene.bounds must be set and not empty.
Camera frame_bounds(const Bounds& bounds);

// Adds presets "omni" (beside the camera) and "spot" (from above, on the middle third of the box); their
// intensities give an irradiance of 3 at the box's centre.
void add_default_lightings(Scene& scene);

}  // namespace relight
