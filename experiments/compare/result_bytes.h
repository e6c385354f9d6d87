// A path tracer's result as bytes for the artefact cache, and back. Native float format and byte order (the
// cache never leaves the machine).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "reference/path_tracer.h"

namespace relight {

std::vector<std::byte> to_bytes(const PathTracerResult& result);
// Nothing if the bytes do not hold a result of width x height pixels.
std::optional<PathTracerResult> result_from_bytes(const std::vector<std::byte>& bytes, int width, int height);

}  // namespace relight
