// Relighting by clustered gather: direct light on gather samples and view, two sums, reconstruction.
#pragma once

#include <memory>

#include "common/run/method.h"
#include "methods/clustered_gather/artefact.h"

namespace relight::clustered_gather {

// On the GPU; with device=oracle the sums are made in double precision on the CPU. Relight stages:
// shadow_maps or shadow_rays, direct_shading, indirect_sum (radiance of each view cluster's gather samples),
// links (the clusters of each pixel), reconstruction.
std::unique_ptr<Prepared> make_prepared_gather(const PrepareContext& context, Artefact artefact);

// On the CPU, without touching the GPU; throws Error for shadows=map.
std::unique_ptr<Prepared> make_prepared_gather_cpu(const PrepareContext& context, Artefact artefact);

}  // namespace relight::clustered_gather
