// How far two pictures are apart, as the hard cases measure it.
#pragma once

#include "common/hard_cases/image_difference.h"

namespace relight::test {

using hard::norm;
using hard::relative_difference;

}  // namespace relight::test
