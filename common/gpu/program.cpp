#include "common/gpu/program.h"

#include <glad/gl.h>

#include <algorithm>
#include <stdexcept>

#include "common/gpu/shader_log.h"
#include "common/gpu/shader_source.h"
#include "common/run/error.h"

namespace relight::gpu {
namespace {

std::string info_log(GLuint id, bool is_shader) {
  GLint length = 0;
  is_shader ? glGetShaderiv(id, GL_INFO_LOG_LENGTH, &length)
            : glGetProgramiv(id, GL_INFO_LOG_LENGTH, &length);
  std::string text(static_cast<size_t>(std::max(length, 0)), '\0');
  if (length > 0) {
    is_shader ? glGetShaderInfoLog(id, length, &length, text.data())
              : glGetProgramInfoLog(id, length, &length, text.data());
    text.resize(static_cast<size_t>(length));
  }
  return text;
}

Object compile(GLenum stage, const std::string& path, const std::vector<std::string>& defines,
               const std::vector<ReplacedFile>& replaced = {}) {
  const ShaderSource source = load_shader(path, defines, replaced);
  Object shader(ObjectKind::shader, glCreateShader(stage));
  const char* text = source.text.c_str();
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GLint ok = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
  if (!ok)
    fail("shader {} does not compile:\n{}", path, explain_shader_log(info_log(shader.id(), true), source));
  return shader;
}

Object link(const std::vector<const Object*>& shaders, const std::string& names) {
  Object program(ObjectKind::program, glCreateProgram());
  for (const Object* shader : shaders) glAttachShader(program.id(), shader->id());
  glLinkProgram(program.id());
  GLint ok = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
  if (!ok) fail("shader program {} does not link:\n{}", names, info_log(program.id(), false));
  for (const Object* shader : shaders) glDetachShader(program.id(), shader->id());
  return program;
}

}  // namespace

Program Program::compute(const std::string& path, const std::vector<std::string>& defines,
                         const std::vector<ReplacedFile>& replaced) {
  const Object shader = compile(GL_COMPUTE_SHADER, path, defines, replaced);
  return Program(link({&shader}, path));
}

Program Program::graphics(const std::string& vertex_path, const std::string& fragment_path,
                          const std::vector<std::string>& defines) {
  const Object vertex = compile(GL_VERTEX_SHADER, vertex_path, defines);
  if (fragment_path.empty()) return Program(link({&vertex}, vertex_path));
  const Object fragment = compile(GL_FRAGMENT_SHADER, fragment_path, defines);
  return Program(link({&vertex, &fragment}, vertex_path + " + " + fragment_path));
}

void Program::use() const { glUseProgram(id()); }

int Program::location(const std::string& name) const {
  const GLint location = glGetUniformLocation(id(), name.c_str());
#ifndef NDEBUG
  if (location < 0) fail("shader program has no uniform '{}', or its compiler removed it", name);
#endif
  return location;
}

void Program::set(const std::string& name, int value) const {
  glProgramUniform1i(id(), location(name), value);
}
void Program::set(const std::string& name, uint32_t value) const {
  glProgramUniform1ui(id(), location(name), value);
}
void Program::set(const std::string& name, float value) const {
  glProgramUniform1f(id(), location(name), value);
}
void Program::set(const std::string& name, const glm::vec2& value) const {
  glProgramUniform2fv(id(), location(name), 1, &value.x);
}
void Program::set(const std::string& name, const glm::uvec2& value) const {
  glProgramUniform2uiv(id(), location(name), 1, &value.x);
}
void Program::set(const std::string& name, const glm::vec3& value) const {
  glProgramUniform3fv(id(), location(name), 1, &value.x);
}
void Program::set(const std::string& name, const glm::vec4& value) const {
  glProgramUniform4fv(id(), location(name), 1, &value.x);
}
void Program::set_if_used(const std::string& name, const glm::vec3& value) const {
  const GLint location = glGetUniformLocation(id(), name.c_str());
  if (location >= 0) glProgramUniform3fv(id(), location, 1, &value.x);
}
void Program::set(const std::string& name, const glm::mat4& value) const {
  glProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, &value[0].x);
}

void Program::dispatch_items(int64_t items, int local_size) const {
  if (items <= 0) return;
  GLint declared[3] = {0, 0, 0};
  glGetProgramiv(id(), GL_COMPUTE_WORK_GROUP_SIZE, declared);
  if (declared[0] != local_size || declared[1] != 1 || declared[2] != 1) {
    throw std::logic_error(fmt::format("dispatch_items: local size {} but the shader declares {} x {} x {}",
                                       local_size, declared[0], declared[1], declared[2]));
  }
  GLint limit = 65535;
  glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &limit);
  const int64_t groups = (items + local_size - 1) / local_size;
  const int64_t columns = std::min<int64_t>(groups, limit);
  use();
  glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>((groups + columns - 1) / columns), 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                  GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace relight::gpu
