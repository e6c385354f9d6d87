#include "experiments/session/session.h"

#include <algorithm>

#include "common/lights/light_animation.h"
#include "common/lights/light_words.h"
#include "common/scene/content_hash.h"
#include "common/scene/scene_file.h"
#include "experiments/options/parse.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

constexpr int max_threads = 1024;

SessionOptions checked(const SessionOptions& options) {
  parse_view(options.view);
  if (options.threads < 0 || options.threads > max_threads) {
    usage_fail("--threads {}: expected 0 (all cores) to {}", options.threads, max_threads);
  }
  if (options.gpu != "osmesa" && options.gpu != "egl" && options.gpu != "auto") {
    usage_fail("--gpu '{}': valid: osmesa, egl, auto", options.gpu);
  }
  return options;
}

template <typename Function>
auto timed(StageLog& log, const char* stage, Function function) {
  const StageTimer timer(log, stage);
  return function();
}

std::string preset_names(const Scene& scene) {
  std::string names;
  for (const auto& [name, lighting] : scene.lightings) append_name(names, name);
  return names.empty() ? "none" : names;
}

}  // namespace

Scene load_named_scene(const std::string& name) {
  if (std::filesystem::exists(name)) return load_scene(name);
  const auto& builtins = builtin_scenes();
  const std::string base = name.substr(0, name.find(':'));
  const bool known =
      std::any_of(builtins.begin(), builtins.end(), [&](const BuiltinScene& b) { return b.name == base; });
  if (!known) {
    std::string names;
    for (const auto& builtin : builtins) append_name(names, builtin.name);
    usage_fail("scene '{}': neither a file nor a built-in scene; valid built-in scenes: {}", name, names);
  }
  try {
    return load_scene(name);
  } catch (const Error& error) {
    throw UsageError(error.what());  // a wrong parameter of a built-in scene was typed, not stored in a file
  }
}

LightingState load_named_lighting(const Scene& scene, const std::string& name) {
  if (!scene.lightings.contains(name) && !std::filesystem::exists(name)) {
    usage_fail("--lights '{}': neither a file nor a preset of scene '{}'; valid presets: {}", name,
               scene.name, preset_names(scene));
  }
  LightingState lighting = load_lighting(scene, name);
  validate(lighting);
  return lighting;
}

std::string choose_lighting(const Scene& scene, const std::string& wanted) {
  if (!wanted.empty()) return wanted;
  if (scene.lightings.contains("default")) return "default";
  if (scene.lightings.size() == 1) return scene.lightings.begin()->first;
  usage_fail("--lights is needed: scene '{}' has these presets: {}", scene.name, preset_names(scene));
}

ChosenLighting choose_lights(const Scene& scene, const std::string& wanted, double time) {
  LightsChoice choice = parse_lights(wanted);
  if (scene.lightings.contains(wanted) || std::filesystem::exists(wanted)) choice = {wanted, {}};
  ChosenLighting chosen;
  chosen.preset = choose_lighting(scene, choice.name);
  chosen.animated = load_named_lighting(scene, chosen.preset);
  if (choice.times.size() > 1)
    usage_fail("--lights '{}': one moment is expected here, e.g. {}", wanted,
               lights_at(chosen.preset, choice.times.front()));
  if (!choice.times.empty() && time != 0.0)
    usage_fail("--lights '{}' and --at {}: two times for one lighting", wanted, time);
  if (!choice.times.empty() && !chosen.animated.animation)
    usage_fail("--lights '{}': nothing in '{}' moves (no keyframes)", wanted, chosen.preset);
  chosen.time = choice.times.empty() ? time : choice.times.front();
  chosen.name = chosen.animated.animation ? lights_at(chosen.preset, chosen.time) : chosen.preset;
  return chosen;
}

View choose_view(const Scene& scene, const std::string& wanted) {
  const ViewChoice choice = parse_view(wanted);
  if (choice.camera.empty()) return {scene.camera, choice.width, choice.height};
  if (const auto found = scene.views.find(choice.camera); found != scene.views.end())
    return {found->second, choice.width, choice.height};
  std::string names;
  for (const auto& [name, camera] : scene.views) append_name(names, name);
  usage_fail("--view '{}': scene '{}' has no view '{}'; valid: {}, or the size alone for its camera", wanted,
             scene.name, choice.camera, names.empty() ? "none" : names);
}

std::string view_hash(const View& view) {
  const Camera& c = view.camera;
  ContentHash hash;
  for (const glm::vec3& v : {c.eye, c.target, c.up}) hash.add(v);
  hash.add(c.fov_y_degrees), hash.add(view.width), hash.add(view.height);
  return fmt::format("{:016x}", hash.value());
}

std::string lighting_hash(const LightingState& standing_still) {
  const std::string text = describe(standing_still);
  ContentHash hash;
  hash.add_bytes(text.data(), text.size());
  return fmt::format("{:016x}", hash.value());
}

ArtefactCache open_cache(const SessionOptions& options) {
  return ArtefactCache(options.cache_folder.empty() ? ArtefactCache::default_folder()
                                                    : std::filesystem::path(options.cache_folder),
                       !options.no_cache);
}

Session::Session(const SessionOptions& options, Gpu gpu)
    : options_(checked(options)),
      threads_(options.threads),
      scene_(timed(setup_, "load_scene", [&] { return load_named_scene(options.scene); })),
      chosen_(choose_lights(scene_, options.lights, options.time)),
      lighting_(lighting_at(chosen_.animated, chosen_.time)),
      cache_(open_cache(options)),
      progress_(options.quiet) {
  if (gpu == Gpu::needed) gpu_ = gpu::Context::create(options.gpu);
  tracer_ = timed(setup_, "build_bvh", [&] { return std::make_unique<RayTracer>(scene_); });
  const View view = choose_view(scene_, options.view);
  buffer_ =
      timed(setup_, "deep_frame_buffer", [&] { return make_deep_frame_buffer(scene_, *tracer_, view); });
}

}  // namespace relight
