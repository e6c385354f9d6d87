#include "experiments/cli/session_flags.h"

namespace relight::cli {

void add_session_flags(Command& command, SessionOptions& options) {
  command
      .add_option("--scene", options.scene,
                  "Built-in scene with parameters (see `relight scene list`), or a file")
      ->required()
      ->type_name("NAME|FILE");
  command
      .add_option("--view", options.view,
                  "Size of the picture in pixels; NAME: before it chooses a view of the scene (see `relight "
                  "scene info`) in place of its camera")
      ->type_name("[NAME:]WxH")
      ->capture_default_str();
  command
      .add_option("--lights", options.lights,
                  "Lighting preset of the scene (see `relight scene info`), or a file; with @SECONDS one "
                  "moment of a lighting that moves")
      ->type_name("PRESET|FILE[@SECONDS]");
  command.add_option("--at", options.time, "Time of a lighting that moves, as --lights NAME@SECONDS says it")
      ->type_name("SECONDS")
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Seed of all random numbers")->capture_default_str();
  add_machine_flags(command, options);
}

void add_machine_flags(Command& command, SessionOptions& options) {
  command.add_option("--threads", options.threads, "Threads, 0 for all cores; results do not depend on it")
      ->capture_default_str();
  command.add_option("--gpu", options.gpu, "OpenGL context: osmesa, egl, or auto (EGL if it is a real GPU)")
      ->type_name("osmesa|egl|auto")
      ->capture_default_str();
  command.add_flag("--no-cache", options.no_cache, "Neither read nor write precomputed data");
  add_cache_folder_flag(command, options);
  command.add_flag("--quiet", options.quiet, "No progress on standard error");
}

void add_cache_folder_flag(Command& command, SessionOptions& options) {
  command
      .add_option("--cache", options.cache_folder,
                  "Folder of precomputed data (default: $RELIGHT_CACHE, else $XDG_CACHE_HOME/relight, else "
                  "~/.cache/relight)")
      ->type_name("DIR");
}

void add_knob_flags(Command& command, std::string& preset, std::vector<std::string>& settings) {
  command
      .add_option("--preset", preset,
                  "Knob values to start from: paper (the defaults), or a preset of a method (see `relight "
                  "methods NAME`)")
      ->type_name("NAME")
      ->capture_default_str();
  command.add_option("--set", settings, "Value of a knob (see `relight methods NAME`); may be repeated")
      ->type_name("METHOD.KNOB=VALUE")
      ->allow_extra_args(false);
}

void add_effect_flags(Command& command, EffectOptions& options) {
  command
      .add_option(
          "--tolerance", options.tolerance,
          "Leave out effects that the scene does not call for, up to this share of the picture, e.g. 1% "
          "(see `relight plan`); absent: knobs decide")
      ->type_name("SHARE");
  command
      .add_option("--effect", options.effects,
                  "Level of an effect, in place of what the planner decides; may be repeated")
      ->type_name("EFFECT=LEVEL")
      ->allow_extra_args(false);
}

}  // namespace relight::cli
