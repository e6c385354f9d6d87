// The only file that sees GL/osmesa.h, which drags in gl.h and would clash with the loader's declarations.
#include <GL/osmesa.h>

#include <array>

#include "common/gpu/context.h"
#include "common/run/error.h"

namespace relight::gpu {
namespace {

class OsmesaContext final : public Context {
 public:
  OsmesaContext() {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0};
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    if (!context_) {
      fail(
          "OSMesa gave no OpenGL 4.5 core context; try --gpu egl, or install Debian's libosmesa6 (Mesa "
          "22.3)");
    }
  }
  ~OsmesaContext() override {
    retire();
    OSMesaDestroyContext(context_);
  }
  Backend backend() const override { return Backend::osmesa; }

 private:
  void bind() override {
    // The default framebuffer is never used, but OSMesa needs one to bind.
    if (!OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, 4, 4)) {
      fail("OSMesa: the context could not be made current; try --gpu egl");
    }
  }
  void unbind() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
  void (*function(const char* name) const)() override {
    return reinterpret_cast<void (*)()>(OSMesaGetProcAddress(name));
  }

  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4 * 4 * 4> pixels_{};
};

}  // namespace

std::unique_ptr<Context> create_osmesa_context() { return std::make_unique<OsmesaContext>(); }

}  // namespace relight::gpu
