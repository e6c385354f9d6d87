// Direct-to-indirect wavelet transfer on the GPU (Hasan, Pellacini, Bala, SIGGRAPH 2006), first version:
// diffuse, one bounce or several. README.md in this folder maps paper sections to files and says what is not
// here yet.
#pragma once

#include <memory>

#include "common/run/method.h"

namespace relight {

std::unique_ptr<Method> make_direct_to_indirect();

}  // namespace relight
