// Runs the built relight program the way a person would, in a folder of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>
#include <nlohmann/json.hpp>

namespace relight::test {

struct ProgramResult {
  int exit_code = -1;
  std::string out, err;
};

// `arguments` as a shell would read them; `prefix` goes before the program ("ulimit -f 8; ").
ProgramResult run_program(const std::string& arguments, const std::string& prefix = "");

// Starts it with these words as its arguments and returns its process; its messages go nowhere.
pid_t start_program(std::vector<std::string> words);

// An empty folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);
// One JSON object a line.
std::vector<nlohmann::json> read_json_lines(const std::filesystem::path& file);

}  // namespace relight::test
