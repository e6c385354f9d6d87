#include "common/gpu/context.h"

#include <glad/gl.h>

#include <array>
#include <optional>

#include "common/run/error.h"

namespace relight::gpu {
namespace {

Context* g_current = nullptr;
std::optional<Backend> g_loaded;  // whose functions glad holds

const char* gl_string(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

std::unique_ptr<Context> hardware_egl_or_null() {
  try {
    auto egl = create_egl_context();
    egl->make_current();
    if (egl->is_hardware()) return egl;
  } catch (const Error&) {
    // "auto" promises a context, not EGL: OSMesa follows.
  }
  return nullptr;
}

}  // namespace

Context::Context() : self_(std::make_shared<Context*>(this)) {}

Context::~Context() = default;

Context* Context::current() { return g_current; }

std::unique_ptr<Context> Context::create(const std::string& which) {
  std::unique_ptr<Context> context;
  if (which == "osmesa") {
    context = create_osmesa_context();
  } else if (which == "egl") {
    context = create_egl_context();
  } else if (which == "auto") {
    context = hardware_egl_or_null();
    if (!context) context = create_osmesa_context();
  } else {
    fail("unknown GPU back end '{}'; valid: osmesa, egl, auto", which);
  }
  context->make_current();
  return context;
}

Context::AnyFunction Context::load_function(const char* name) { return g_current->function(name); }

void Context::make_current() {
  if (g_current == this) return;
  // Both back ends may share Mesa's dispatch table, and each skips a bind that it believes is in force
  // already; so whoever leaves must be told.
  if (g_current) g_current->unbind();
  g_current = nullptr;
  bind();
  g_current = this;
  if (g_loaded != backend()) {
    g_loaded.reset();
    if (gladLoadGL(&Context::load_function) == 0 || !GLAD_GL_VERSION_4_5) {
      fail("GPU back end {}: OpenGL 4.5 functions could not be loaded",
           backend() == Backend::osmesa ? "osmesa" : "egl");
    }
    g_loaded = backend();
  }
}

void Context::retire() {
  self_.reset();
  if (g_current != this) return;
  unbind();
  g_current = nullptr;
}

std::string Context::renderer() const { return gl_string(GL_RENDERER); }

std::string Context::version() const { return gl_string(GL_VERSION); }

bool Context::is_hardware() const {
  const std::string name = renderer();
  for (const char* software :
       {"llvmpipe", "softpipe", "swrast", "SWR", "SwiftShader", "Software Rasterizer"}) {
    if (name.find(software) != std::string::npos) return false;
  }
  return true;
}

int64_t Context::max_storage_block_bytes() const {
  GLint64 bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  return bytes;
}

void check_gl(const char* where) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  switch (error) {
    case GL_OUT_OF_MEMORY:
      fail("{}: OpenGL ran out of memory", where);
    case GL_INVALID_ENUM:
      fail("{}: OpenGL error GL_INVALID_ENUM", where);
    case GL_INVALID_VALUE:
      fail("{}: OpenGL error GL_INVALID_VALUE", where);
    case GL_INVALID_OPERATION:
      fail("{}: OpenGL error GL_INVALID_OPERATION", where);
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      fail("{}: OpenGL error GL_INVALID_FRAMEBUFFER_OPERATION", where);
    default:
      fail("{}: OpenGL error 0x{:x}", where, error);
  }
}

}  // namespace relight::gpu
