#include "planted_effects.h"

#include "common/run/error.h"
#include "common/shading/direct_lighting.h"
#include "common/shading/reconstruction.h"

namespace relight::test {

namespace {

Image direct_light(const EffectSite& site) {
  const View& view = site.buffer.view;
  return box_filter_2x2(
      shade_direct_cpu(site.tracer, site.buffer.direct, view.camera.eye, site.lighting, Lobes::all),
      view.width, view.height);
}

Effect terms_effect() {
  Effect effect{"terms", "Terms of a made-up expansion.", {}};
  for (int n = 1; n <= 4; ++n) effect.levels.push_back({std::to_string(n), {{"terms", std::to_string(n)}}});
  effect.lacks = [](const EffectSite& site) {
    const Image direct = direct_light(site);
    std::vector<Image> lacks(4, direct);
    for (int n = 1; n <= 4; ++n)
      for (glm::vec3& p : lacks[static_cast<size_t>(n - 1)].pixels) p *= 0.01f * static_cast<float>(4 - n);
    return lacks;
  };
  effect.needless = [](const EffectSite& site) -> std::string {
    return site.scene.name == "plain" ? "the scene is plain" : "";
  };
  return effect;
}

class Planted : public Method {
 public:
  std::string name() const override { return "planted"; }
  std::string summary() const override { return "Has effects."; }
  std::string paper() const override { return "None."; }
  KnobTable knobs() const override {
    using enum KnobType;
    using enum KnobPhase;
    return {{"depth", integer, precompute, "1", 0, 3, {}, "depth", "Bounces."},
            {"terms", integer, precompute, "4", 1, 4, {}, "terms", "Terms."}};
  }
  LightPaths light_paths(const KnobValues& knobs) const override {
    LightPaths paths;
    paths.max_bounces = static_cast<int>(knobs.integer("depth"));
    return paths;
  }
  std::vector<Effect> effects(const KnobValues&) const override {
    return {bounces_effect("depth", 3), terms_effect()};
  }
  std::unique_ptr<Prepared> prepare(const PrepareContext&) const override { fail("not to be run"); }
};

}  // namespace

std::unique_ptr<Method> make_planted_method() { return std::make_unique<Planted>(); }

}  // namespace relight::test
