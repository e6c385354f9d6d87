// Direct-to-indirect transfer as a method: name, knobs, light paths; precompute.h and prepared_transfer.h do
// the work.
#include "common/shading/direct_only.h"
#include "common/shading/soft_shadows_effect.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "methods/direct_to_indirect/error_stages.h"
#include "methods/direct_to_indirect/knobs.h"
#include "methods/direct_to_indirect/precompute.h"
#include "methods/direct_to_indirect/prepared_transfer.h"
#include "methods/direct_to_indirect/prepared_transfer_cpu.h"

namespace relight {
namespace direct_to_indirect {
namespace {

class DirectToIndirect : public Method {
 public:
  std::string name() const override { return "direct_to_indirect"; }
  std::string summary() const override {
    return "Direct light on a gather cloud, carried to the view by a sparse matrix in wavelet space "
           "(diffuse, glossy at the visible surface; one bounce or several).";
  }
  std::string paper() const override {
    return "Hasan, Pellacini, Bala: Direct-to-Indirect Transfer for Cinematic Relighting, SIGGRAPH 2006";
  }
  KnobTable knobs() const override { return knob_table(); }
  std::vector<KnobPreset> presets() const override { return knob_presets(); }
  LightPaths light_paths(const KnobValues& knobs) const override {
    LightPaths paths;
    paths.max_bounces = static_cast<int>(knobs.integer("bounces"));
    paths.glossy_at_eye = knobs.choice("glossy") == "auto";
    // Without a bounce there is nothing but the direct light of lamps (direct_only.h).
    paths.environment = knobs.choice("environment") != "off" && paths.max_bounces > 0;
    return paths;
  }
  ErrorStages error_stages(const KnobValues& knobs) const override {
    return direct_to_indirect::error_stages(knobs);
  }
  std::vector<Effect> effects(const KnobValues&) const override {
    return {
        bounces_effect("bounces", 8),
        switch_effect("glossy_final_gather", "Indirect light in glossy reflections at the visible surface.",
                      "glossy", "off", "auto"),
        switch_effect("environment", "Light from the environment.", "environment", "off", "auto"),
        soft_shadows_effect("area_light_samples")};
  }
  std::unique_ptr<Prepared> prepare(const PrepareContext& context) const override {
    if (context.knobs.integer("bounces") == 0) return make_direct_only(name(), context);
    Artefact artefact = load_or_precompute(context);
    StageTimer timer(context.log, "upload");
    if (context.knobs.choice("device") == "cpu")
      return make_prepared_transfer_cpu(context, std::move(artefact));
    return make_prepared_transfer(context, std::move(artefact));
  }
};

}  // namespace
}  // namespace direct_to_indirect

std::unique_ptr<Method> make_direct_to_indirect() {
  return std::make_unique<direct_to_indirect::DirectToIndirect>();
}

}  // namespace relight
