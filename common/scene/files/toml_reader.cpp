#include "common/scene/files/toml_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "common/run/error.h"

namespace relight {

struct TomlTable::State {
  std::shared_ptr<const toml::table> document;  // keeps `table` alive
  const toml::table* table = nullptr;
  std::filesystem::path file;
  std::string path;  // e.g. "lighting.spot[1]."; empty for the document
  std::vector<std::string> asked;

  const toml::node* find(const std::string& key) {
    if (std::find(asked.begin(), asked.end(), key) == asked.end()) asked.push_back(key);
    return table->get(key);
  }
  std::string at(const toml::node& node, const std::string& key) const {
    std::string field = path + key;
    if (key.empty() && !field.empty()) field.pop_back();  // the table itself, without its dot
    return fmt::format("{}:{}: {}", file.string(), node.source().begin.line, field);
  }
};

namespace {

std::string show(const toml::node& node) {
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  return out.str();
}

std::string show(const NumberRange& range) {
  if (range.min <= -1e30 && range.max >= 1e30) return "a finite number";
  if (range.max >= 1e30) return fmt::format("a number {} {}", range.open_min ? ">" : ">=", range.min);
  return fmt::format("a number {} {} and <= {}", range.open_min ? ">" : ">=", range.min, range.max);
}

double checked_number(const toml::node& node, const std::string& where, const NumberRange& range) {
  const auto value = node.value<double>();
  if (!value || !node.is_number()) fail("{}: {} is not a number; valid: {}", where, show(node), show(range));
  const bool inside = (range.open_min ? *value > range.min : *value >= range.min) && *value <= range.max;
  if (!std::isfinite(*value) || !inside)
    fail("{}: {} is out of range; valid: {}", where, show(node), show(range));
  return *value;
}

glm::vec3 checked_vector(const toml::node& node, const std::string& where, const NumberRange& range) {
  const toml::array* array = node.as_array();
  if (!array || array->size() != 3) fail("{}: {} is not a list of three numbers", where, show(node));
  glm::vec3 v;
  for (int k = 0; k < 3; ++k)
    v[k] = static_cast<float>(
        checked_number(*array->get(static_cast<size_t>(k)), fmt::format("{}[{}]", where, k), range));
  return v;
}

}  // namespace

TomlTable TomlTable::parse_file(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) fail("{}: no such file", file.string());
  try {
    auto state = std::make_shared<State>();
    state->document = std::make_shared<const toml::table>(toml::parse_file(file.string()));
    state->table = state->document.get();
    state->file = file;
    return TomlTable(state);
  } catch (const toml::parse_error& error) {
    fail("{}:{}: not valid TOML: {}", file.string(), error.source().begin.line, error.description());
  }
}

bool TomlTable::has(const std::string& key) const { return state_->find(key) != nullptr; }

double TomlTable::number(const std::string& key, double fallback, const NumberRange& range) const {
  const toml::node* node = state_->find(key);
  return node ? checked_number(*node, state_->at(*node, key), range) : fallback;
}

glm::vec3 TomlTable::vector(const std::string& key, const glm::vec3& fallback,
                            const NumberRange& range) const {
  const toml::node* node = state_->find(key);
  return node ? checked_vector(*node, state_->at(*node, key), range) : fallback;
}

glm::vec3 TomlTable::colour(const std::string& key, const glm::vec3& fallback,
                            const NumberRange& range) const {
  const toml::node* node = state_->find(key);
  if (!node) return fallback;
  if (node->is_number())
    return glm::vec3(static_cast<float>(checked_number(*node, state_->at(*node, key), range)));
  if (!node->is_array())
    fail("{}: {} is neither a number nor a list of three numbers", state_->at(*node, key), show(*node));
  return checked_vector(*node, state_->at(*node, key), range);
}

bool TomlTable::boolean(const std::string& key, bool fallback) const {
  const toml::node* node = state_->find(key);
  if (!node) return fallback;
  if (!node->is_boolean())
    fail("{}: {} is not a boolean; valid: true, false", state_->at(*node, key), show(*node));
  return node->value_or(fallback);
}

std::string TomlTable::text(const std::string& key, const std::string& fallback,
                            const std::vector<std::string>& choices) const {
  const toml::node* node = state_->find(key);
  if (!node) return fallback;
  if (!node->is_string()) fail("{}: {} is not a string", state_->at(*node, key), show(*node));
  const std::string value = node->value_or(std::string());
  if (!choices.empty() && std::find(choices.begin(), choices.end(), value) == choices.end())
    fail("{}: '{}' is not valid; valid: {}", state_->at(*node, key), value, fmt::join(choices, ", "));
  return value;
}

std::vector<std::string> TomlTable::values(const std::string& key) const {
  const toml::node* node = state_->find(key);
  if (!node) return {};
  std::vector<std::string> texts;
  const auto add = [&](const toml::node& value) {
    if (value.is_string())
      texts.push_back(value.value_or(std::string()));
    else if (value.is_integer())
      texts.push_back(fmt::format("{}", value.value_or(int64_t{0})));
    else if (value.is_floating_point())
      texts.push_back(fmt::format("{}", value.value_or(0.0)));
    else if (value.is_boolean())
      texts.push_back(value.value_or(false) ? "true" : "false");
    else
      fail("{}: {} is not a string, a number or a boolean", state_->at(*node, key), show(value));
  };
  if (const toml::array* array = node->as_array()) {
    if (array->empty()) fail("{}: an empty list; expected at least one value", state_->at(*node, key));
    for (const toml::node& value : *array) add(value);
  } else {
    add(*node);
  }
  return texts;
}

std::filesystem::path TomlTable::file(const std::string& key) const {
  if (!has(key)) return {};
  const std::filesystem::path name = replace_variables(text(key, ""), where(key));
  return name.is_absolute() ? name : (state_->file.parent_path() / name).lexically_normal();
}

TomlTable TomlTable::table(const std::string& key) const {
  const toml::node* node = state_->find(key);
  auto state = std::make_shared<State>(*state_);
  state->asked.clear();
  state->path = state_->path + key + ".";
  static const toml::table empty;
  state->table = &empty;
  if (node) {
    if (!node->is_table())
      fail("{}: {} is not a table; write [{}]", state_->at(*node, key), show(*node), key);
    state->table = node->as_table();
  }
  return TomlTable(state);
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) const {
  const toml::node* node = state_->find(key);
  if (!node) return {};
  const toml::array* array = node->as_array();
  if (!array) fail("{}: not an array of tables; write [[{}{}]]", state_->at(*node, key), state_->path, key);
  std::vector<TomlTable> result;
  for (size_t i = 0; i < array->size(); ++i) {
    const toml::node& element = *array->get(i);
    if (!element.is_table())
      fail("{}: element {} is {}, not a table; write [[{}{}]]", state_->at(element, key), i + 1,
           show(element), state_->path, key);
    auto state = std::make_shared<State>(*state_);
    state->asked.clear();
    state->path = fmt::format("{}{}[{}].", state_->path, key, i + 1);
    state->table = element.as_table();
    result.push_back(TomlTable(state));
  }
  return result;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, node] : *state_->table) names.emplace_back(key.str());
  return names;
}

void TomlTable::require(const std::string& key) const {
  if (!has(key)) fail("{}: '{}' is missing", where(), key);
}

void TomlTable::refuse_unknown_keys() const {
  for (const auto& [key, node] : *state_->table) {
    const std::string name(key.str());
    if (std::find(state_->asked.begin(), state_->asked.end(), name) != state_->asked.end()) continue;
    fail("{}:{}: {}{} is not known; valid keys here: {}", state_->file.string(), key.source().begin.line,
         state_->path, name, fmt::join(state_->asked, ", "));
  }
}

std::string TomlTable::where(const std::string& key) const {
  const toml::node* node = key.empty() ? state_->table : state_->find(key);
  return state_->at(node ? *node : *state_->table, key);
}

std::string replace_variables(const std::string& text, const std::string& where) {
  std::string result;
  for (size_t at = 0; at < text.size();) {
    const size_t open = text.find("${", at);
    result += text.substr(at, open == std::string::npos ? open : open - at);
    if (open == std::string::npos) break;
    const size_t close = text.find('}', open);
    if (close == std::string::npos) fail("{}: '{}': ${{ without }}", where, text);
    const std::string inside = text.substr(open + 2, close - open - 2);
    const size_t dash = inside.find(":-");
    const std::string name = inside.substr(0, dash);
    const char* value = std::getenv(name.c_str());
    if (value && *value)
      result += value;
    else if (dash != std::string::npos)
      result += inside.substr(dash + 2);
    else
      fail("{}: '{}': environment variable {} is not set; set it, or write ${{{}:-default}}", where, text,
           name, name);
    at = close + 1;
  }
  return result;
}

}  // namespace relight
