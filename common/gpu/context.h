// An OpenGL 4.5 core context without a window: OSMesa (no display, no GPU needed) or EGL (a GPU, or Mesa
// surfaceless). Functions are loaded through the back end's own address function (libepoxy aborts under
// OSMesa). All GL work happens on one thread: the function pointers are global to the process.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace relight::gpu {

enum class Backend { osmesa, egl };

class Context {
 public:
  // which: "osmesa", "egl" or "auto" (EGL if it gives a hardware renderer, else OSMesa). Throws Error that
  // says what failed and what to try. The context is current on the calling thread afterwards.
  static std::unique_ptr<Context> create(const std::string& which);
  // The context that is current, or null.
  static Context* current();

  virtual ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Makes this context current and, if another back end was current before, loads the GL functions again.
  void make_current();
  virtual Backend backend() const = 0;
  std::string renderer() const;  // GL_RENDERER
  std::string version() const;   // GL_VERSION
  // False for a rasteriser that runs on the CPU (llvmpipe, softpipe, swrast).
  bool is_hardware() const;
  int64_t max_storage_block_bytes() const;
  // Dies with the context: lets GL objects know whether there is still something to delete.
  std::weak_ptr<Context*> handle() const { return self_; }

 protected:
  Context();
  // Every derived destructor calls this first: leaves the context if it is current and invalidates handle().
  void retire();

 private:
  using AnyFunction = void (*)();
  virtual void bind() = 0;
  virtual void unbind() = 0;
  virtual AnyFunction function(const char* name) const = 0;
  static AnyFunction load_function(const char* name);
  std::shared_ptr<Context*> self_;
};

// Back ends; use Context::create.
std::unique_ptr<Context> create_osmesa_context();
std::unique_ptr<Context> create_egl_context();

// Throws Error naming `where` if GL has recorded an error since the last call.
void check_gl(const char* where);

}  // namespace relight::gpu
