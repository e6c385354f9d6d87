// Plans on the scenes made for it (scenes/effects), and a closed sphere whose answers are known.
#pragma once

#include <memory>
#include <string>

#include "experiments/compare/plan.h"
#include "experiments/effects/plan_effects.h"
#include "experiments/session/session.h"
#include "tests/reference/render.h"

namespace relight::test {

// Path of scenes/effects/NAME.toml, or NAME itself if it is no such file.
std::string effect_scene(const std::string& name);

// A quiet session without cache.
SessionOptions session_options(const std::string& scene, const std::string& lights,
                               const std::string& view = "40x30");

struct PlanCase {
  std::string scene, lights, method;
  std::vector<std::string> settings = {};         // "knob=value" of the method
  std::map<std::string, std::string> asked = {};  // --effect
  double tolerance = 0.01;
  std::string view = "40x30";
  uint64_t seed = 1;
  int threads = 0;
};
EffectPlan plan_of(const PlanCase& c);

// The decision on an effect; std::logic_error if the plan has none.
const EffectDecision& decision(const EffectPlan& plan, const std::string& effect);

// A closed sphere of that albedo seen from inside, with a lamp in its centre: after k bounces its even
// radiance is albedo^k times the direct one.
tiny::Rendering lit_sphere(float albedo, int width, int height);
LightingState lamp_in_the_centre();

// Share of the picture that bounces `from` to `most` are in that sphere, of all up to `most`.
double share_of_bounces(double albedo, int from, int most);

}  // namespace relight::test
