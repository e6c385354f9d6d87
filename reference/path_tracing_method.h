// Plain path tracing as a relighting method: no precompute, and at each relight as many paths as a time or
// sample budget allows. It shows in every comparison what the same time buys without precomputed transport.
// Its random numbers are independent of the reference's for the same seed, so that their errors don't cancel.
#pragma once

#include <memory>

#include "common/run/method.h"

namespace relight {

std::unique_ptr<Method> make_path_tracing();

}  // namespace relight
