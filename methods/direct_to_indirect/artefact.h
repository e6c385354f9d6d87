// What direct-to-indirect precomputes, and its form in the artefact cache.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/run/method.h"
#include "common/sampling/gather_cloud.h"
#include "methods/direct_to_indirect/environment_transfer.h"
#include "methods/direct_to_indirect/final_gather.h"
#include "methods/direct_to_indirect/multi_bounce.h"

namespace relight::direct_to_indirect {

struct Artefact {
  GatherCloud cloud;                        // in tree order; diffuse albedos include the column scaling
  std::vector<SurfaceSample> light_points;  // four a gather sample (light_points.h), likewise, or none
  FinalGather final_gather;                 // wavelet space
  MultiBounce multi_bounce;
  EnvironmentTransfer environment;  // empty unless wants_environment(); then it takes no bytes
};

// Is light from the environment prepared for? The knob `environment`, or with auto: is there any?
bool wants_environment(const PrepareContext& context);

// Everything the artefact depends on, in words. Contains the version of this folder's precompute code: raise
// it with any change of the numbers.
std::string cache_key(const PrepareContext& context);

// Of that, what the gather cloud depends on too: scene, view, seed and the version.
std::string view_key(const PrepareContext& context);

// The samples on which direct light is computed.
inline const std::vector<SurfaceSample>& lit_points(const Artefact& artefact) {
  return artefact.light_points.empty() ? artefact.cloud.samples : artefact.light_points;
}

std::vector<std::byte> to_bytes(const Artefact& artefact);
// Throws Error if the bytes are not an artefact of this format.
Artefact from_bytes(const std::vector<std::byte>& bytes);

}  // namespace relight::direct_to_indirect
