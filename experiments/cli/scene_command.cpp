// relight scene list | info NAME|FILE | export NAME|FILE
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "common/scene/scene_file.h"
#include "experiments/cli/commands.h"
#include "experiments/mitsuba/export.h"
#include "experiments/session/session.h"
#include "experiments/usage_error.h"

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

struct ExportOptions {
  std::string format;
  MitsubaExportOptions mitsuba;
};

int export_scene(const ExportOptions& options) {
  if (options.format != "mitsuba") usage_fail("--format '{}': valid: mitsuba", options.format);
  fmt::print("{}", export_mitsuba(options.mitsuba));
  return 0;
}

void add_export_command(Command& parent, Action& action) {
  Command* command = parent.add_subcommand(
      "export", "The scene, its lights and the view as input of another renderer (see docs/mitsuba.md)");
  const auto options = std::make_shared<ExportOptions>();
  MitsubaExportOptions& mitsuba = options->mitsuba;
  command->add_option("scene", mitsuba.scene, "Built-in scene with parameters, or a file")
      ->required()
      ->type_name("NAME|FILE");
  command->add_option("--format", options->format, "For which renderer")->required()->type_name("mitsuba");
  command
      ->add_option("--lights", mitsuba.lights,
                   "Lighting preset of the scene (see `relight scene info`), or a file; with @SECONDS one "
                   "moment of a lighting that moves")
      ->type_name("PRESET|FILE[@SECONDS]");
  command->add_option("--view", mitsuba.view, "Size of the picture in pixels, NAME: before it for a view")
      ->type_name("[NAME:]WxH")
      ->capture_default_str();
  command->add_option("--max-bounces", mitsuba.max_bounces, "Bounces of indirect light, 0: direct light only")
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--out", mitsuba.out, "Folder for scene.xml, meshes, textures and render.py")
      ->required()
      ->type_name("DIR");
  command->callback([&action, options] { action = [options] { return export_scene(*options); }; });
}

}  // namespace

void add_scene_command(Command& app, Action& action) {
  Command* command =
      app.add_subcommand("scene", "Built-in scenes, what is in a scene, and scenes for other renderers");
  command->require_subcommand(1);
  Command* list = command->add_subcommand("list", "The built-in scenes and their parameters");
  list->callback([&action] { action = list_scenes; });
  Command* info = command->add_subcommand(
      "info",
      "Sizes, closedness, albedo range, glossy share, environment, lighting presets and repairs of a scene");
  const auto name = std::make_shared<std::string>();
  info->add_option("scene", *name, "Built-in scene with parameters, or a file")
      ->required()
      ->type_name("NAME|FILE");
  info->callback([&action, name] { action = [name] { return scene_info(*name); }; });
  add_export_command(*command, action);
}

}  // namespace relight::cli
