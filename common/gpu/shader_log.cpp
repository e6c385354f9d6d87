#include "common/gpu/shader_log.h"

#include <cstdio>
#include <sstream>

namespace relight::gpu {
namespace {

// Line of the expanded text that a log line names (0: none), and where its message starts.
struct Place {
  int line = 0, message = 0;
};

Place find_place(const std::string& log_line) {
  int source = 0, line = 0, column = 0, message = 0;
  const char* s = log_line.c_str();
  if (std::sscanf(s, "%d:%d(%d): %n", &source, &line, &column, &message) == 3 && message > 0)
    return {line, message};
  message = 0;
  if (std::sscanf(s, "%d(%d) : %n", &source, &line, &message) == 2 && message > 0) return {line, message};
  message = 0;
  if (std::sscanf(s, "ERROR: %d:%d: %n", &source, &line, &message) == 2 && message > 0)
    return {line, message};
  return {};
}

std::string text_line(const std::string& text, int number) {
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < number; ++i) std::getline(lines, line);
  return line;
}

}  // namespace

std::string explain_shader_log(const std::string& log, const ShaderSource& source) {
  std::istringstream log_lines(log);
  std::string out, line;
  while (std::getline(log_lines, line)) {
    if (line.empty() || line.front() == '\0') continue;
    const Place place = find_place(line);
    const bool known = place.line >= 1 && place.line <= static_cast<int>(source.lines.size());
    const ShaderSource::Origin origin =
        known ? source.lines[static_cast<size_t>(place.line - 1)] : ShaderSource::Origin{-1, 0};
    if (origin.file < 0) {
      out += line + '\n';
      continue;
    }
    out += source.files[static_cast<size_t>(origin.file)] + ':' + std::to_string(origin.line) + ": " +
           line.substr(static_cast<size_t>(place.message)) + '\n';
    out += "    " + text_line(source.text, place.line) + '\n';
  }
  return out;
}

}  // namespace relight::gpu
