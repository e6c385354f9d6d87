// A linked GLSL program. Compile and link errors throw Error with file, line and the source line itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace relight::gpu {

class Program {
 public:
  static Program compute(const std::string& path, const std::vector<std::string>& defines = {});
  static Program graphics(const std::string& vertex_path, const std::string& fragment_path,
                          const std::vector<std::string>& defines = {});
  ~Program();
  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;

  void use() const;
  // Setting a uniform that the program does not have (or that was optimised away) is an Error in debug builds only.
  void set(const std::string& name, int value) const;
  void set(const std::string& name, uint32_t value) const;
  void set(const std::string& name, float value) const;
  void set(const std::string& name, const glm::vec3& value) const;
  void set(const std::string& name, const glm::vec4& value) const;
  void set(const std::string& name, const glm::mat4& value) const;
  // Runs ceil(items / local_size) workgroups (local_size as declared in the shader) and a storage barrier.
  void dispatch_items(int64_t items, int local_size) const;
  uint32_t id() const { return id_; }

 private:
  explicit Program(uint32_t id) : id_(id) {}
  uint32_t id_ = 0;
};

}  // namespace relight::gpu
