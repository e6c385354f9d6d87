// What the subcommands need of CLI11, so that its 9,400 lines of templates are compiled in two files only.
// Names and meanings are CLI11's.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace relight::cli {

class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option* required();
  Option* type_name(const std::string& name);
  Option* capture_default_str();
  Option* allow_extra_args(bool allow);
  Option* excludes(Option* other);
  Option* non_negative();
  Option* within(int first, int last);
  Option* hidden();  // not in --help

 private:
  CLI::Option* option_;
};

// A subcommand and the options that it declares. Pointers that it returns are valid as long as it lives.
class Command {
 public:
  explicit Command(CLI::App& app);
  ~Command();
  Option* add_option(const std::string& name, std::string& value, const std::string& help = "");
  Option* add_option(const std::string& name, int& value, const std::string& help = "");
  Option* add_option(const std::string& name, int64_t& value, const std::string& help = "");
  Option* add_option(const std::string& name, uint64_t& value, const std::string& help = "");
  Option* add_option(const std::string& name, double& value, const std::string& help = "");
  Option* add_option(const std::string& name, std::vector<std::string>& values, const std::string& help = "");
  Option* add_flag(const std::string& name, bool& value, const std::string& help = "");
  Command* add_subcommand(const std::string& name, const std::string& help);
  void require_subcommand(int count);
  void callback(std::function<void()> chosen);
  void footer(const std::string& text);

 private:
  template <typename Value>
  Option* add(const std::string& name, Value& value, const std::string& help);
  Option* keep(CLI::Option* option);
  CLI::App& app_;
  std::vector<std::unique_ptr<Option>> options_;
  std::vector<std::unique_ptr<Command>> commands_;
};

}  // namespace relight::cli
