// Relight of direct-to-indirect transfer, equation 7:
//   v_i = k_d * (F_d^w W (M^w W + I) g_d),  M = 0 with one bounce;  image = direct + upsampled v_i.
#pragma once

#include <memory>

#include "common/run/method.h"
#include "methods/direct_to_indirect/artefact.h"

namespace relight::direct_to_indirect {

// Uploads the artefact; logs its bytes.
std::unique_ptr<Prepared> make_prepared_transfer(const PrepareContext& context, Artefact artefact);

}  // namespace relight::direct_to_indirect
