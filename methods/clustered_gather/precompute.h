// Everything clustered gather does before a light is known: view clusters, gather samples, links.
#pragma once

#include "common/run/method.h"
#include "methods/clustered_gather/artefact.h"

namespace relight::clustered_gather {

// The artefact from the cache, or computed and stored. A cache that cannot be written costs a warning, not
// the run. Logs precompute stages and counters.
Artefact load_or_precompute(const PrepareContext& context);

}  // namespace relight::clustered_gather
