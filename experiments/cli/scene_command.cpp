// relight scene list | info NAME|FILE
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "common/scene/scene_file.h"
#include "experiments/cli/commands.h"
#include "experiments/session/session.h"

namespace relight::cli {

namespace {

int list_scenes() {
  for (const BuiltinScene& scene : builtin_scenes()) {
    fmt::print("{}\n    {}\n", scene.name, scene.summary);
    for (const auto& p : scene.parameters) {
      fmt::print("    {}={}  [{}, {}]  {}\n", p.name, p.default_value, p.min, p.max, p.help);
    }
  }
  fmt::print("\nSet parameters after a colon: NAME:parameter=value,parameter=value\n");
  return 0;
}

int scene_info(const std::string& name) {
  const Scene scene = load_named_scene(name);
  fmt::print("{}\n", describe_scene(scene));
  return 0;
}

}  // namespace

void add_scene_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("scene", "Built-in scenes, and what is in a scene");
  command->require_subcommand(1);
  CLI::App* list = command->add_subcommand("list", "The built-in scenes and their parameters");
  list->callback([&action] { action = list_scenes; });
  CLI::App* info = command->add_subcommand(
      "info",
      "Sizes, closedness, albedo range, glossy share, environment, lighting presets and repairs of a scene");
  const auto name = std::make_shared<std::string>();
  info->add_option("scene", *name, "Built-in scene with parameters, or a file")
      ->required()
      ->type_name("NAME|FILE");
  info->callback([&action, name] { action = [name] { return scene_info(*name); }; });
}

}  // namespace relight::cli
