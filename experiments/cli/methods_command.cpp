// relight methods [NAME]
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "experiments/cli/commands.h"
#include "experiments/method_list.h"
#include "experiments/options/knob_text.h"

namespace relight::cli {

namespace {

int list_methods() {
  for (const auto& method : make_all_methods()) {
    fmt::print("{}\n    {}\n    {}\n    carries by default: {}\n", method->name(), method->summary(),
               method->paper(), method->light_paths(KnobValues(method->knobs())).to_string());
  }
  fmt::print("\n`relight methods NAME` prints the knobs of one.\n");
  return 0;
}

int describe_method(const std::string& name) {
  const MethodList methods = make_all_methods();
  const Method& method = find_method(methods, name);
  fmt::print("{}\n{}\n{}\ncarries by default: {}\n\n{}\nSet a knob with --set {}.KNOB=VALUE\n\n{}",
             method.name(), method.summary(), method.paper(),
             method.light_paths(KnobValues(method.knobs())).to_string(), knob_table_text(method.knobs()),
             method.name(), presets_text(method.presets()));
  return 0;
}

}  // namespace

void add_methods_command(Command& app, Action& action) {
  Command* command = app.add_subcommand("methods", "The relighting methods, or the knobs of one");
  const auto name = std::make_shared<std::string>();
  command->add_option("method", *name, "Print the knob table of this method")->type_name("NAME");
  command->callback([&action, name] {
    action = [name] { return name->empty() ? list_methods() : describe_method(*name); };
  });
}

}  // namespace relight::cli
