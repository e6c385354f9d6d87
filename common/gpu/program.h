// A linked GLSL program. Compile and link errors throw Error with file, line and the source line itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "common/gpu/object.h"
#include "common/gpu/shader_source.h"

namespace relight::gpu {

class Program {
 public:
  static Program compute(const std::string& path, const std::vector<std::string>& defines = {},
                         const std::vector<ReplacedFile>& replaced = {});
  // `fragment_path` empty: depth only.
  static Program graphics(const std::string& vertex_path, const std::string& fragment_path,
                          const std::vector<std::string>& defines = {});

  void use() const;
  // Setting a uniform that the program does not have (or that was optimised away) is an Error in debug builds
  // only.
  void set(const std::string& name, int value) const;
  void set(const std::string& name, uint32_t value) const;
  void set(const std::string& name, float value) const;
  void set(const std::string& name, const glm::vec2& value) const;
  void set(const std::string& name, const glm::uvec2& value) const;
  void set(const std::string& name, const glm::vec3& value) const;
  void set(const std::string& name, const glm::vec4& value) const;
  void set(const std::string& name, const glm::mat4& value) const;
  // Nothing happens if the program has no such uniform.
  void set_if_used(const std::string& name, const glm::vec3& value) const;
  // Runs ceil(items / local_size) workgroups (local_size as declared in the shader) and a storage barrier.
  // Beyond the driver's limit in x (at least 65535 groups) the groups wrap into y: shaders that may see so
  // many items take their index from item_index() in common/gpu/item_index.glsl. Throws std::logic_error on a
  // wrong local_size.
  void dispatch_items(int64_t items, int local_size) const;
  uint32_t id() const { return object_.id(); }

 private:
  explicit Program(Object object) : object_(std::move(object)) {}
  int location(const std::string& name) const;
  Object object_;
};

}  // namespace relight::gpu
