// relight render
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/render/render.h"

namespace relight::cli {

void add_render_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("render", "One picture by one method, without a reference");
  const auto options = std::make_shared<RenderOptions>();
  add_session_flags(*command, options->session);
  command->add_option("--method", options->method, "Method (see `relight methods`)")
      ->required()
      ->type_name("NAME");
  add_knob_flags(*command, options->preset, options->settings);
  command->add_option("--image", options->image, "Which light")
      ->type_name("direct|indirect|total")
      ->capture_default_str();
  command->add_option("--out", options->out, "File: .exr for radiance, .png for the scene's exposure in sRGB")
      ->required()
      ->type_name("FILE");
  command->callback([&action, options] {
    action = [options] {
      const MethodList methods = make_all_methods();
      fmt::print("{}", render(*options, methods));
      return 0;
    };
  });
}

}  // namespace relight::cli
