// Reads TOML tables with full error reports: every message names file:line, field, the value found and what
// is valid, and a key that nobody asked for is refused with the list of keys that somebody did ask for.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace relight {

struct NumberRange {
  double min = -1e30, max = 1e30;
  bool open_min = false;  // min itself is not valid
};

class TomlTable {
 public:
  // Throws Error with line and column if the file is missing or not TOML.
  static TomlTable parse_file(const std::filesystem::path& file);

  bool has(const std::string& key) const;
  // The value of `key`, or `fallback` if it is missing. Wrong type or value: Error.
  double number(const std::string& key, double fallback, const NumberRange& range = {}) const;
  glm::vec3 vector(const std::string& key, const glm::vec3& fallback, const NumberRange& range = {}) const;
  // Three numbers, or one for all three.
  glm::vec3 colour(const std::string& key, const glm::vec3& fallback, const NumberRange& range = {}) const;
  bool boolean(const std::string& key, bool fallback) const;
  // choices: valid values; empty = any.
  std::string text(const std::string& key, const std::string& fallback,
                   const std::vector<std::string>& choices = {}) const;
  // One or several strings, numbers or booleans, as text; empty if missing. A list must not be empty.
  std::vector<std::string> values(const std::string& key) const;
  // A file name: ${NAME} and ${NAME:-default} are replaced by the environment variable; relative names are
  // relative to the TOML file's folder. Empty if missing.
  std::filesystem::path file(const std::string& key) const;
  // A sub-table; an empty one if missing.
  TomlTable table(const std::string& key) const;
  // An array of tables; empty if missing.
  std::vector<TomlTable> tables(const std::string& key) const;
  std::vector<std::string> keys() const;

  void require(const std::string& key) const;
  // Call after reading: refuses keys that none of the calls above named.
  void refuse_unknown_keys() const;
  // "file:line: field" of a key (or of the table itself for ""), for messages of the caller.
  std::string where(const std::string& key = "") const;

 private:
  struct State;
  explicit TomlTable(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

// Replaces ${NAME} and ${NAME:-default}. `where` begins the Error for a variable that is neither set nor
// given a default.
std::string replace_variables(const std::string& text, const std::string& where);

}  // namespace relight
