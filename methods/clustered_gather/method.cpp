// Clustered Monte Carlo gather as a method: name, knobs, light paths; precompute.h and prepared_gather.h do
// the work.
#include "common/shading/direct_only.h"
#include "common/shading/soft_shadows_effect.h"
#include "methods/clustered_gather/clustered_gather.h"
#include "methods/clustered_gather/error_stages.h"
#include "methods/clustered_gather/knobs.h"
#include "methods/clustered_gather/precompute.h"
#include "methods/clustered_gather/prepared_gather.h"

namespace relight {
namespace clustered_gather {
namespace {

class ClusteredGather : public Method {
 public:
  std::string name() const override { return "clustered_gather"; }
  std::string summary() const override {
    return "Direct light on gather samples of clustered view samples, themselves clustered from Monte Carlo "
           "rays (one bounce; glossy only at the view).";
  }
  std::string paper() const override {
    return "One-bounce indirect illumination for deep-framebuffer relighting by clustered Monte Carlo "
           "gathering "
           "(the authors of direct-to-indirect transfer, 2006; the title page is missing from the text at "
           "hand)";
  }
  KnobTable knobs() const override { return knob_table(); }
  LightPaths light_paths(const KnobValues& knobs) const override {
    LightPaths paths;
    paths.max_bounces = static_cast<int>(knobs.integer("bounces"));
    paths.glossy_at_eye = knobs.choice("glossy") == "auto";
    // Without a bounce there is nothing but the direct light of lamps (direct_only.h).
    paths.environment = knobs.choice("environment") != "off" && paths.max_bounces > 0;
    if (paths.environment) paths.environment_bounces = 0;
    return paths;
  }
  std::vector<Effect> effects(const KnobValues&) const override {
    return {
        bounces_effect("bounces", 1),
        switch_effect("glossy_final_gather", "Indirect light in glossy reflections at the visible surface.",
                      "glossy", "off", "auto"),
        switch_effect("environment", "Light from the environment.", "environment", "off", "auto"),
        soft_shadows_effect("area_light_samples")};
  }
  ErrorStages error_stages(const KnobValues& knobs) const override {
    return clustered_gather::error_stages(knobs);
  }
  std::unique_ptr<Prepared> prepare(const PrepareContext& context) const override {
    if (context.knobs.integer("bounces") == 0) return make_direct_only(name(), context);
    Artefact artefact = load_or_precompute(context);
    StageTimer timer(context.log, "upload");
    if (context.knobs.choice("device") == "cpu")
      return make_prepared_gather_cpu(context, std::move(artefact));
    return make_prepared_gather(context, std::move(artefact));
  }
};

}  // namespace
}  // namespace clustered_gather

std::unique_ptr<Method> make_clustered_gather() {
  return std::make_unique<clustered_gather::ClusteredGather>();
}

}  // namespace relight
