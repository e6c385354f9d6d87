// The gather cloud in tree order and its hierarchy: what the view asks for, whatever light and matrices are
// to be.
#pragma once

#include "common/run/method.h"
#include "common/sampling/gather_cloud.h"
#include "methods/direct_to_indirect/hierarchy.h"

namespace relight::direct_to_indirect {

// Bounces of indirect light in all, the final gather's included.
int bounces(const KnobValues& knobs);

// A cloud of that many samples, not yet ordered: where particles of importance go, and how it is spread.
GatherCloud make_cloud(const PrepareContext& context, int64_t samples, uint64_t seed);

struct GatherStructure {
  GatherCloud cloud;  // in tree order, albedos not yet scaled by columns
  // With light_points=4 four a gather sample, likewise; else empty: direct light is computed on the cloud.
  std::vector<SurfaceSample> light_points;
  GatherHierarchy hierarchy;
};

// Knobs gather_samples, light_points, cloud, hierarchy_k and bounces, on the whole view. The cloud is kept in
// context.parts where there are any. Logs stages gather_cloud and hierarchy; a cloud that was kept has no
// stage gather_cloud.
GatherStructure make_gather_structure(const PrepareContext& context);

}  // namespace relight::direct_to_indirect
