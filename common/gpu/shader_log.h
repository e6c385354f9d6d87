// Makes a driver's compile log readable: line numbers of the expanded text become file and line, and the
// source line is quoted.
#pragma once

#include <string>

#include "common/gpu/shader_source.h"

namespace relight::gpu {

// Understands "0:12(5): error: ..." (Mesa), "0(12) : error ..." (NVIDIA) and "ERROR: 0:12: ..." (Intel, AMD);
// other lines stay as they are.
std::string explain_shader_log(const std::string& log, const ShaderSource& source);

}  // namespace relight::gpu
