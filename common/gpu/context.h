// An OpenGL 4.5 core context without a window: OSMesa (no display, no GPU needed) or EGL (a GPU, or Mesa
// surfaceless). Functions are loaded through the back end's own address function (libepoxy aborts under OSMesa).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace relight::gpu {

enum class Backend { osmesa, egl };

class Context {
 public:
  // which: "osmesa", "egl" or "auto" (EGL if it gives a hardware renderer, else OSMesa). Throws Error that says what
  // failed and what to try. The context is current on the calling thread afterwards.
  static std::unique_ptr<Context> create(const std::string& which);
  virtual ~Context() = default;
  virtual void make_current() = 0;
  virtual Backend backend() const = 0;
  std::string renderer() const;  // GL_RENDERER
  std::string version() const;   // GL_VERSION
  int64_t max_storage_block_bytes() const;
};

}  // namespace relight::gpu
