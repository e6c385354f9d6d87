// Relight of direct-to-indirect transfer without a GPU: the equations of prepared_transfer.h in float on all
// cores, with traced shadows. device=oracle is its double-precision twin.
#pragma once

#include <memory>

#include "common/run/method.h"
#include "methods/direct_to_indirect/artefact.h"

namespace relight::direct_to_indirect {

// Throws Error for knobs that ask for what only the GPU does (shadows=map). Logs the bytes it holds.
std::unique_ptr<Prepared> make_prepared_transfer_cpu(const PrepareContext& context, Artefact artefact);

}  // namespace relight::direct_to_indirect
