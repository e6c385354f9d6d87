// Shader text by its path in the source tree: embedded at build time, or read from the folder named by the
// environment variable RELIGHT_SHADER_DIR. Resolves #include "path/from/the/root.glsl" (each file once).
#pragma once

#include <string>
#include <vector>

namespace relight::gpu {

struct EmbeddedShader {
  const char* path;
  const char* text;
};
extern const EmbeddedShader embedded_shaders[];
extern const int embedded_shader_count;

// Source ready for glShaderSource: "#version 450 core", the RL_* macros of common/glsl_in_cpp.h, `defines`
// (e.g. "LOCAL_SIZE 64"), then the file with its includes expanded. Throws Error on an unknown path, naming
// the known ones.
struct ShaderSource {
  std::string text;
  std::vector<std::string> files;  // every file taken, the main one first
  // Where line i + 1 of `text` comes from: index into files (-1: none) and line from 1. Kept here instead of
  // #line directives because Mesa forgets the source number inside expressions.
  struct Origin {
    int file, line;
  };
  std::vector<Origin> lines;
};
// A file whose place in the source tree another text takes, e.g. code of the user; messages name `shown_as`.
struct ReplacedFile {
  std::string path, shown_as, text;
};
ShaderSource load_shader(const std::string& path, const std::vector<std::string>& defines = {},
                         const std::vector<ReplacedFile>& replaced = {});

}  // namespace relight::gpu
