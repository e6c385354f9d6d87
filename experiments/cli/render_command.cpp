// relight render
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/render/render_frames.h"

namespace relight::cli {

void add_render_command(Command& app, Action& action) {
  Command* command = app.add_subcommand("render", "Pictures by one method, without a reference");
  const auto options = std::make_shared<RenderOptions>();
  add_session_flags(*command, options->session);
  command->add_option("--method", options->method, "Method (see `relight methods`)")
      ->required()
      ->type_name("NAME");
  add_knob_flags(*command, options->preset, options->settings);
  add_effect_flags(*command, options->effects);
  command->add_option("--image", options->image, "Which light")
      ->type_name("direct|indirect|total")
      ->capture_default_str();
  command->add_option("--out", options->out, "File: .exr for radiance, .png for the scene's exposure in sRGB")
      ->required()
      ->type_name("FILE");
  struct Wanted {
    std::string frames, times;
  };
  const auto wanted = std::make_shared<Wanted>();
  Option* frames =
      command
          ->add_option(
              "--frames", wanted->frames,
              "Pictures of an animated lighting, at number / fps seconds; --out x.png gives x_0001.png")
          ->type_name("FIRST:LAST[:STEP]");
  command->add_option("--times", wanted->times, "The same at these times, numbered from 1")
      ->type_name("SECONDS,...")
      ->excludes(frames);
  command->add_option("--fps", options->fps, "Frames a second of --frames")
      ->type_name("N")
      ->capture_default_str();
  command->add_flag("--resume", options->resume, "Keep frames that are there already");
  command->callback([&action, options, wanted] {
    action = [options, wanted] {
      const MethodList methods = make_all_methods();
      if (!wanted->frames.empty())
        fmt::print("{}", render_frames(*options, parse_frames(wanted->frames, options->fps), methods));
      else if (!wanted->times.empty())
        fmt::print("{}", render_frames(*options, parse_times(wanted->times), methods));
      else
        fmt::print("{}", render(*options, methods));
      return 0;
    };
  });
}

}  // namespace relight::cli
