// Contexts for tests: OSMesa must work; EGL may be missing, and then says why.
#pragma once

#include <cstdlib>
#include <memory>
#include <string>

#include "common/gpu/context.h"
#include "common/run/error.h"

namespace relight::test {

// Null, with the reason, if EGL gives no context here.
inline std::unique_ptr<gpu::Context> egl_or_null(std::string& reason) {
  try {
    return gpu::Context::create("egl");
  } catch (const Error& e) {
    reason = std::string("no EGL context on this machine: ") + e.what();
    return nullptr;
  }
}

// Sets RELIGHT_SHADER_DIR for its lifetime.
class ShaderDir {
 public:
  explicit ShaderDir(const std::string& folder) { setenv("RELIGHT_SHADER_DIR", folder.c_str(), 1); }
  ~ShaderDir() { unsetenv("RELIGHT_SHADER_DIR"); }
  ShaderDir(const ShaderDir&) = delete;
  ShaderDir& operator=(const ShaderDir&) = delete;
};

}  // namespace relight::test
