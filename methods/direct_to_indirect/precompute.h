// Everything direct-to-indirect does before a light is known: gather cloud, hierarchy, matrices.
#pragma once

#include "common/run/method.h"
#include "methods/direct_to_indirect/artefact.h"

namespace relight::direct_to_indirect {

// The artefact from the cache, or computed and stored. A cache that cannot be written costs a warning, not
// the run. Logs precompute stages and counters.
Artefact load_or_precompute(const PrepareContext& context);

}  // namespace relight::direct_to_indirect
