#include "plan_cases.h"

#include <cmath>
#include <stdexcept>

#include "experiments/compare/effect_run.h"
#include "experiments/method_list.h"

namespace relight::test {

std::string effect_scene(const std::string& name) {
  const std::string file = std::string(RELIGHT_SOURCE_DIR) + "/scenes/effects/" + name + ".toml";
  return std::filesystem::exists(file) ? file : name;
}

SessionOptions session_options(const std::string& scene, const std::string& lights, const std::string& view) {
  SessionOptions options;
  options.scene = effect_scene(scene);
  options.lights = lights;
  options.view = view;
  options.quiet = true;
  options.no_cache = true;
  return options;
}

EffectPlan plan_of(const PlanCase& c) {
  const MethodList methods = make_all_methods();
  const Method& method = find_method(methods, c.method);
  std::vector<std::string> settings;
  for (const std::string& s : c.settings) settings.push_back(c.method + "." + s);
  MethodPlan plan = plan_method(method, parse_settings(settings, {&method}));
  SessionOptions options = session_options(c.scene, c.lights, c.view);
  options.seed = c.seed;
  options.threads = c.threads;
  Session session(options, Session::Gpu::not_needed);
  return plan_and_apply({c.tolerance, c.asked, false}, plan, session);
}

const EffectDecision& decision(const EffectPlan& plan, const std::string& effect) {
  for (const EffectDecision& d : plan.effects)
    if (d.effect == effect) return d;
  throw std::logic_error("no decision on " + effect);
}

tiny::Rendering lit_sphere(float albedo, int width, int height) {
  Scene scene = tiny::empty_scene(glm::vec3(albedo));
  tiny::add_sphere(scene, glm::vec3(0.0f), 1.0f, 192);  // facets fine enough for the series
  scene.camera.eye = {0.0f, 0.0f, 0.3f};
  scene.camera.target = {0.1f, 0.05f, -1.0f};
  scene.camera.fov_y_degrees = 60.0f;
  scene.exposure = 0.05f;  // no pixel is clamped
  finish_scene(scene);
  return tiny::Rendering(std::move(scene), width, height);
}

LightingState lamp_in_the_centre() { return tiny::lighting({tiny::omni(glm::vec3(0.0f), glm::vec3(10.0f))}); }

double share_of_bounces(double albedo, int from, int most) {
  double some = 0.0, all = 0.0;
  for (int k = 0; k <= most; ++k) {
    all += std::pow(albedo, k);
    if (k >= from) some += std::pow(albedo, k);
  }
  return some / all;
}

}  // namespace relight::test
