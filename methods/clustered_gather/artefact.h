// What clustered gather precomputes, and its form in the artefact cache.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/run/method.h"
#include "methods/clustered_gather/gather_samples.h"
#include "methods/clustered_gather/view_clusters.h"

namespace relight::clustered_gather {

struct Artefact {
  GatherSamples gather;
  Links diffuse, glossy;  // glossy view clusters are numbered after the diffuse ones; none without gloss
};

// Is light from the environment prepared for? The knob `environment`, or with auto: is there any?
bool wants_environment(const PrepareContext& context);

// Everything the artefact depends on, in words. Contains the version of this folder's precompute code: raise
// it with any change of the numbers.
std::string cache_key(const PrepareContext& context);

// Only what shading needs of a sample: position, two normals, albedo.
std::vector<std::byte> to_bytes(const Artefact& artefact);
// Throws Error if the bytes are not an artefact of this format.
Artefact from_bytes(const std::vector<std::byte>& bytes);

}  // namespace relight::clustered_gather
