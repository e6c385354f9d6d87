// The approximations of clustered gather and their exact twins, for `relight explain-error`.
#pragma once

#include "common/run/error_stages.h"
#include "common/run/knobs.h"

namespace relight::clustered_gather {

// Exact from the picture back to the rays: shadows, interpolation between view clusters, the view clusters
// themselves, gather clusters. What is left is the finite number of directions, and that indirect light is
// computed once a pixel (the method has no knob against that).
ErrorStages error_stages(const KnobValues& knobs);

}  // namespace relight::clustered_gather
