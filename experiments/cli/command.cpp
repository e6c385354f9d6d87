#include "experiments/cli/command.h"

#include <CLI/CLI.hpp>

namespace relight::cli {

Option* Option::required() { return option_->required(), this; }
Option* Option::type_name(const std::string& name) { return option_->type_name(name), this; }
Option* Option::capture_default_str() { return option_->capture_default_str(), this; }
Option* Option::allow_extra_args(bool allow) { return option_->allow_extra_args(allow), this; }
Option* Option::excludes(Option* other) { return option_->excludes(other->option_), this; }
Option* Option::non_negative() { return option_->check(CLI::NonNegativeNumber), this; }
Option* Option::within(int first, int last) { return option_->check(CLI::Range(first, last)), this; }
Option* Option::hidden() { return option_->group(""), this; }

Command::Command(CLI::App& app) : app_(app) {}
Command::~Command() = default;

Option* Command::keep(CLI::Option* option) {
  return options_.emplace_back(std::make_unique<Option>(option)).get();
}

template <typename Value>
Option* Command::add(const std::string& name, Value& value, const std::string& help) {
  return keep(app_.add_option(name, value, help));
}

Option* Command::add_option(const std::string& name, std::string& value, const std::string& help) {
  return add(name, value, help);
}
Option* Command::add_option(const std::string& name, int& value, const std::string& help) {
  return add(name, value, help);
}
Option* Command::add_option(const std::string& name, int64_t& value, const std::string& help) {
  return add(name, value, help);
}
Option* Command::add_option(const std::string& name, uint64_t& value, const std::string& help) {
  return add(name, value, help);
}
Option* Command::add_option(const std::string& name, double& value, const std::string& help) {
  return add(name, value, help);
}
Option* Command::add_option(const std::string& name, std::vector<std::string>& values,
                            const std::string& help) {
  return add(name, values, help);
}
Option* Command::add_flag(const std::string& name, bool& value, const std::string& help) {
  return keep(app_.add_flag(name, value, help));
}

Command* Command::add_subcommand(const std::string& name, const std::string& help) {
  return commands_.emplace_back(std::make_unique<Command>(*app_.add_subcommand(name, help))).get();
}

void Command::require_subcommand(int count) { app_.require_subcommand(count); }
void Command::callback(std::function<void()> chosen) { app_.callback(std::move(chosen)); }
void Command::footer(const std::string& text) { app_.footer(text); }

}  // namespace relight::cli
