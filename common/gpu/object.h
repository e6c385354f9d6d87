// Owner of one GL object name. Deleting works whatever context is current then, and does nothing when the
// object's context is gone (its objects went with it).
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

namespace relight::gpu {

class Context;

enum class ObjectKind { buffer, texture, framebuffer, vertex_array, query, shader, program };

class Object {
 public:
  Object() = default;
  // Takes over `id`, which belongs to the current context. Throws std::logic_error if no context is current.
  Object(ObjectKind kind, uint32_t id);
  ~Object() { reset(); }
  Object(Object&& other) noexcept
      : kind_(other.kind_), id_(std::exchange(other.id_, 0)), context_(std::move(other.context_)) {}
  Object& operator=(Object&& other) noexcept;
  uint32_t id() const { return id_; }
  void reset() noexcept;

 private:
  ObjectKind kind_ = ObjectKind::buffer;
  uint32_t id_ = 0;
  std::weak_ptr<Context*> context_;
};

// Creates an object of any kind but shader and program (which need more than a name).
Object create_object(ObjectKind kind, uint32_t target = 0);  // target: of a texture or query

}  // namespace relight::gpu
