#include "common/run/error.h"
#include "common/shading/cached_direct_light.h"
#include "common/shading/fused_reconstruction.h"
#include "common/shading/kept_environment.h"
#include "common/shading/lit_samples_cpu.h"
#include "methods/clustered_gather/environment_light.h"
#include "methods/clustered_gather/prepared_gather.h"
#include "methods/clustered_gather/storage.h"
#include "methods/clustered_gather/sums_cpu.h"

namespace relight::clustered_gather {
namespace {

Artefact rounded(Artefact artefact, SampleFormat format) {
  round_weights(artefact.diffuse, format), round_weights(artefact.glossy, format);
  return artefact;
}

class PreparedGatherCpu : public Prepared {
 public:
  PreparedGatherCpu(const PrepareContext& context, Artefact artefact)
      : scene_environment_(context.scene.environment),
        samples_("clustered_gather", context.tracer, context.buffer, context.knobs,
                 cpu_samples(std::move(artefact.gather.samples), storage(context.knobs))),
        direct_(samples_.make()),
        kept_environment_("clustered_gather", context.knobs, artefact.gather.environment.columns > 0),
        environment_(make_environment_light(context, artefact.gather, false)),
        sums_(rounded(std::move(artefact), storage(context.knobs)), context.buffer),
        reconstruction_(context.buffer) {
    context.log.bytes("gather_samples", samples_.gather.bytes());
    context.log.bytes("view_samples", samples_.view.bytes() + reconstruction_.bytes());
    context.log.bytes("links", sums_.bytes());
    context.log.bytes("partial_results", direct_.bytes());
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
    const bool lit_from_afar =
        kept_environment_.update(lighting.environment_or(scene_environment_), [&](const Environment& e) {
          const EnvironmentLight::InterpolateCpu interpolate = [&](const std::vector<glm::dvec3>& gathered) {
            return sums_.interpolate<double>(gathered);
          };
          environment_->update(e, interpolate, log);
        });
    const LitSamplesCpuResult& direct = direct_.shade(samples_, lighting, log);
    std::vector<glm::vec3> gathered;
    {
      const StageTimer timer(log, "indirect_sum");
      gathered = sums_.gathered<float>(direct.gather);
    }
    std::vector<glm::vec4> indirect;
    {
      const StageTimer timer(log, "links");
      indirect = sums_.interpolate<float>(gathered);
    }
    FusedReconstruction::Images images = reconstruction_.resolve(direct.view, indirect, log);
    if (lit_from_afar) {
      add_image(environment_->picture(), images.direct);
      add_image(environment_->picture(), images.total);
    }
    return {std::move(images.direct), std::move(images.indirect), std::move(images.total)};
  }
  void forget() override {
    direct_.forget();
    kept_environment_.forget();
  }

 private:
  const Environment& scene_environment_;
  LitSamplesCpu samples_;
  CachedDirectLight<LitSamplesCpuResult> direct_;
  KeptEnvironment kept_environment_;
  std::optional<EnvironmentLight> environment_;  // none unless prepared for
  SumsCpu sums_;
  FusedReconstruction reconstruction_;
};

}  // namespace

std::unique_ptr<Prepared> make_prepared_gather_cpu(const PrepareContext& context, Artefact artefact) {
  return std::make_unique<PreparedGatherCpu>(context, std::move(artefact));
}

}  // namespace relight::clustered_gather
