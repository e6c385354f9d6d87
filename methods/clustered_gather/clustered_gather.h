// Clustered Monte Carlo gather: README.md of this folder says of which paper, and what is not done.
#pragma once

#include <memory>

#include "common/run/method.h"

namespace relight {

std::unique_ptr<Method> make_clustered_gather();

}  // namespace relight
