// EGL without a window system: first the hardware devices, then Mesa's surfaceless platform, then software
// devices.
#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>
#include <map>
#include <vector>

#include "common/gpu/context.h"
#include "common/run/error.h"

namespace relight::gpu {
namespace {

template <typename F>
F extension_function(const char* name) {
  return reinterpret_cast<F>(eglGetProcAddress(name));
}

bool lists(const char* extensions, const char* name) {
  const size_t length = std::strlen(name);
  for (const char* p = extensions; p && (p = std::strstr(p, name)); p += length) {
    const bool starts = p == extensions || p[-1] == ' ';
    if (starts && (p[length] == ' ' || p[length] == '\0')) return true;
  }
  return false;
}

std::vector<EGLDisplay> candidate_displays() {
  std::vector<EGLDisplay> hardware, software, all;
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto platform_display =
      extension_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  const auto query_devices = extension_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto device_string = extension_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (platform_display && query_devices && device_string && lists(client, "EGL_EXT_platform_device")) {
    EGLDeviceEXT devices[32];
    EGLint count = 0;
    if (!query_devices(32, devices, &count)) count = 0;
    for (EGLint i = 0; i < count; ++i) {
      const bool is_software = lists(device_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
      EGLDisplay display = platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
      if (display != EGL_NO_DISPLAY) (is_software ? software : hardware).push_back(display);
    }
  }
  all = hardware;
  if (platform_display && lists(client, "EGL_MESA_platform_surfaceless")) {
    EGLDisplay display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY) all.push_back(display);
  }
  all.insert(all.end(), software.begin(), software.end());
  return all;
}

// EGL hands the same display to everyone in the process: the last user terminates it.
std::map<EGLDisplay, int>& display_users() {
  static std::map<EGLDisplay, int> users;
  return users;
}

bool acquire_display(EGLDisplay display) {
  if (display_users()[display] == 0 && !eglInitialize(display, nullptr, nullptr)) return false;
  ++display_users()[display];
  return true;
}

void release_display(EGLDisplay display) {
  if (--display_users()[display] == 0) eglTerminate(display);
}

// A 4.5 core context that binds without a surface, or EGL_NO_CONTEXT.
EGLContext context_on(EGLDisplay display) {
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!lists(extensions, "EGL_KHR_surfaceless_context") || !eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  EGLConfig config = EGL_NO_CONFIG_KHR;
  if (!lists(extensions, "EGL_KHR_no_config_context")) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint found = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &found) || found == 0) return EGL_NO_CONTEXT;
  }
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
}

class EglContext final : public Context {
 public:
  EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
  ~EglContext() override {
    retire();
    eglDestroyContext(display_, context_);
    release_display(display_);
  }
  Backend backend() const override { return Backend::egl; }

 private:
  void bind() override {
    if (!eglBindAPI(EGL_OPENGL_API) || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      fail("EGL: the context could not be made current (EGL error 0x{:x}); try --gpu osmesa", eglGetError());
    }
  }
  void unbind() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
  void (*function(const char* name) const)() override { return eglGetProcAddress(name); }

  EGLDisplay display_;
  EGLContext context_;
};

}  // namespace

std::unique_ptr<Context> create_egl_context() {
  for (EGLDisplay display : candidate_displays()) {
    if (!acquire_display(display)) continue;
    const EGLContext context = context_on(display);
    if (context != EGL_NO_CONTEXT) return std::make_unique<EglContext>(display, context);
    release_display(display);
  }
  fail(
      "EGL gave no OpenGL 4.5 core context without a window (EGL error 0x{:x}); try --gpu osmesa, or install "
      "a "
      "driver with EGL_KHR_surfaceless_context (Debian: libegl-mesa0)",
      eglGetError());
}

}  // namespace relight::gpu
