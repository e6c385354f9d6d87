#include "common/run/error.h"
#include "common/shading/cached_direct_light.h"
#include "common/shading/fused_reconstruction.h"
#include "common/shading/lit_samples_cpu.h"
#include "methods/clustered_gather/prepared_gather.h"
#include "methods/clustered_gather/sums_cpu.h"

namespace relight::clustered_gather {
namespace {

class PreparedGatherCpu : public Prepared {
 public:
  PreparedGatherCpu(const PrepareContext& context, Artefact artefact)
      : samples_("clustered_gather", context.tracer, context.buffer, context.knobs, artefact.gather.samples),
        direct_(samples_.make()),
        sums_(std::move(artefact), context.buffer),
        reconstruction_(context.buffer) {
    context.log.bytes("gather_samples", samples_.gather.bytes());
    context.log.bytes("view_samples", samples_.view.bytes() + reconstruction_.bytes());
    context.log.bytes("links", sums_.bytes());
    context.log.bytes("partial_results", direct_.bytes());
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
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
    return {std::move(images.direct), std::move(images.indirect), std::move(images.total)};
  }
  void forget() override { direct_.forget(); }

 private:
  LitSamplesCpu samples_;
  CachedDirectLight<LitSamplesCpuResult> direct_;
  SumsCpu sums_;
  FusedReconstruction reconstruction_;
};

}  // namespace

std::unique_ptr<Prepared> make_prepared_gather_cpu(const PrepareContext& context, Artefact artefact) {
  return std::make_unique<PreparedGatherCpu>(context, std::move(artefact));
}

}  // namespace relight::clustered_gather
