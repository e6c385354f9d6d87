#include "common/gpu/shader_source.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

#include "common/run/error.h"

namespace relight::gpu {
namespace {

// The GLSL side of common/glsl_in_cpp.h.
constexpr const char* language_macros[] = {"#define RL_FUNCTION", "#define RL_CONST const"};

std::string known_paths() {
  std::string list;
  for (int i = 0; i < embedded_shader_count; ++i)
    list += std::string(i ? ", " : "") + embedded_shaders[i].path;
  return list;
}

std::string read_text(const std::string& path, const std::string& included_from) {
  if (const char* folder = std::getenv("RELIGHT_SHADER_DIR"); folder && *folder) {
    std::ifstream file(std::filesystem::path(folder) / path, std::ios::binary);
    std::ostringstream text;
    if (file && text << file.rdbuf()) return text.str();
    fail("{}shader '{}' is not in RELIGHT_SHADER_DIR={}; known: {}", included_from, path, folder,
         known_paths());
  }
  for (int i = 0; i < embedded_shader_count; ++i) {
    if (path == embedded_shaders[i].path) return embedded_shaders[i].text;
  }
  fail("{}unknown shader '{}'; known: {}", included_from, path, known_paths());
}

// The quoted path of an #include line, or empty if the line is something else.
std::string include_path(const std::string& line, const std::string& file, int number) {
  std::string_view rest(line);
  const auto skip_blanks = [&rest] {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  };
  skip_blanks();
  if (rest.empty() || rest.front() != '#') return {};
  rest.remove_prefix(1);
  skip_blanks();
  if (!rest.starts_with("include")) return {};
  const size_t open = line.find('"');
  const size_t close = open == std::string::npos ? open : line.find('"', open + 1);
  if (close == std::string::npos || close == open + 1) {
    fail("{}:{}: #include needs a quoted path from the root of the source tree, got: {}", file, number, line);
  }
  return line.substr(open + 1, close - open - 1);
}

class Expander {
 public:
  Expander(ShaderSource& out, const std::vector<ReplacedFile>& replaced) : out_(out), replaced_(replaced) {}

  void line(const std::string& text, int file, int number) {
    out_.text += text + '\n';
    out_.lines.push_back({file, number});
  }

  // Appends the file with its includes. A file that was already taken, even one still open (a cycle), adds
  // nothing.
  void file(const std::string& path, const std::string& included_from) {
    if (!seen_.insert(path).second) return;
    const ReplacedFile* other = find_replaced(path);
    std::istringstream lines(other ? other->text : read_text(path, included_from));
    const int index = static_cast<int>(out_.files.size());
    const std::string& shown = other ? other->shown_as : path;
    out_.files.push_back(shown);
    std::string text;
    for (int number = 1; std::getline(lines, text); ++number) {
      const std::string included = include_path(text, shown, number);
      if (included.empty()) {
        line(text, index, number);
      } else {
        file(included, fmt::format("{}:{}: ", shown, number));
      }
    }
  }

 private:
  const ReplacedFile* find_replaced(const std::string& path) const {
    for (const ReplacedFile& file : replaced_)
      if (file.path == path) return &file;
    return nullptr;
  }

  ShaderSource& out_;
  const std::vector<ReplacedFile>& replaced_;
  std::set<std::string> seen_;
};

}  // namespace

ShaderSource load_shader(const std::string& path, const std::vector<std::string>& defines,
                         const std::vector<ReplacedFile>& replaced) {
  ShaderSource source;
  Expander expander(source, replaced);
  expander.line("#version 450 core", -1, 0);
  for (const char* macro : language_macros) expander.line(macro, -1, 0);
  for (const std::string& define : defines) expander.line("#define " + define, -1, 0);
  expander.file(path, "");
  return source;
}

}  // namespace relight::gpu
