#include "common/gpu/object.h"

#include <glad/gl.h>

#include <stdexcept>

#include "common/gpu/context.h"

namespace relight::gpu {
namespace {

void delete_object(ObjectKind kind, GLuint id) {
  switch (kind) {
    case ObjectKind::buffer:
      glDeleteBuffers(1, &id);
      break;
    case ObjectKind::texture:
      glDeleteTextures(1, &id);
      break;
    case ObjectKind::framebuffer:
      glDeleteFramebuffers(1, &id);
      break;
    case ObjectKind::vertex_array:
      glDeleteVertexArrays(1, &id);
      break;
    case ObjectKind::query:
      glDeleteQueries(1, &id);
      break;
    case ObjectKind::shader:
      glDeleteShader(id);
      break;
    case ObjectKind::program:
      glDeleteProgram(id);
      break;
  }
}

}  // namespace

Object::Object(ObjectKind kind, uint32_t id) : kind_(kind), id_(id) {
  if (!Context::current()) throw std::logic_error("GL object made without a current context");
  context_ = Context::current()->handle();
}

Object& Object::operator=(Object&& other) noexcept {
  if (this == &other) return *this;
  reset();
  kind_ = other.kind_;
  id_ = std::exchange(other.id_, 0);
  context_ = std::move(other.context_);
  return *this;
}

void Object::reset() noexcept {
  const std::shared_ptr<Context*> owner = context_.lock();
  if (id_ != 0 && owner) {
    Context* before = Context::current();
    (*owner)->make_current();
    delete_object(kind_, id_);
    if (before && before != *owner) before->make_current();
  }
  id_ = 0;
}

Object create_object(ObjectKind kind, uint32_t target) {
  if (!Context::current()) throw std::logic_error("GL object made without a current context");
  GLuint id = 0;
  switch (kind) {
    case ObjectKind::buffer:
      glCreateBuffers(1, &id);
      break;
    case ObjectKind::texture:
      glCreateTextures(target, 1, &id);
      break;
    case ObjectKind::framebuffer:
      glCreateFramebuffers(1, &id);
      break;
    case ObjectKind::vertex_array:
      glCreateVertexArrays(1, &id);
      break;
    case ObjectKind::query:
      glCreateQueries(target, 1, &id);
      break;
    default:
      throw std::logic_error("create_object: shaders and programs are made by Program");
  }
  return Object(kind, id);
}

}  // namespace relight::gpu
