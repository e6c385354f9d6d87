#include "planted_method.h"

#include <chrono>
#include <limits>
#include <thread>

#include "reference/path_tracer.h"

namespace relight::test {
namespace {

class PlantedPrepared : public Prepared {
 public:
  PlantedPrepared(const PrepareContext& context, std::string broken)
      : context_(context), knobs_(context.knobs), broken_(std::move(broken)) {}

  Relit relight(const LightingState& lighting, StageLog& log) override {
    PathTracerSettings settings;
    settings.samples_per_pixel = 512;
    settings.seed = 1234;  // other random numbers than the reference's
    Progress quiet(true);
    PathTracerResult traced = path_trace(context_.tracer, context_.buffer, lighting, settings, quiet, log);
    if (knobs_.choice("direct") == "wrong")
      for (glm::vec3& p : traced.direct.pixels) p *= 1.3f;
    for (glm::vec3& p : traced.indirect.pixels) {
      if (knobs_.choice("dim") == "wrong") p *= 0.8f;
      if (knobs_.choice("tint") == "wrong") p.y *= 1.5f;
    }
    if (!broken_.empty() && knobs_.choice(broken_) == "exact")
      for (glm::vec3& p : traced.indirect.pixels) p.x = std::numeric_limits<float>::quiet_NaN();
    return {traced.direct, traced.indirect, traced.total()};
  }

 private:
  PrepareContext context_;
  KnobValues knobs_;
  std::string broken_;
};

class PlantedMethod : public Method {
 public:
  explicit PlantedMethod(std::string broken) : broken_(std::move(broken)) {}
  std::string name() const override { return "planted"; }
  std::string summary() const override { return "A fake."; }
  std::string paper() const override { return "None."; }
  KnobTable knobs() const override {
    const auto knob = [](const std::string& name, KnobPhase phase) {
      return Knob{name, KnobType::choice,   phase,  "exact",          0,
                  0,    {"exact", "wrong"}, "fake", "Right or wrong."};
    };
    return {knob("direct", KnobPhase::relight), knob("dim", KnobPhase::precompute),
            knob("tint", KnobPhase::relight)};
  }
  LightPaths light_paths(const KnobValues&) const override { return {}; }
  ErrorStages error_stages(const KnobValues& knobs) const override {
    ErrorStages out;
    for (const char* name : {"direct", "dim", "tint"})
      out.stages.push_back({name, "Wrong on purpose.", {{name, "exact"}}, knobs.choice(name) == "wrong"});
    out.remainder = "noise", out.remainder_sentence = "Of two path traced pictures.";
    return out;
  }
  std::unique_ptr<Prepared> prepare(const PrepareContext& context) const override {
    if (context.knobs.choice("dim") == "exact") std::this_thread::sleep_for(std::chrono::milliseconds(30));
    return std::make_unique<PlantedPrepared>(context, broken_);
  }

 private:
  std::string broken_;
};

}  // namespace

std::unique_ptr<Method> make_planted_method(const std::string& broken) {
  return std::make_unique<PlantedMethod>(broken);
}

}  // namespace relight::test
