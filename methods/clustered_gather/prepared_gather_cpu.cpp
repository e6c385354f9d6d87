#include "common/run/error.h"
#include "common/shading/block_lighting.h"
#include "common/shading/cached_direct_light.h"
#include "common/shading/fused_reconstruction.h"
#include "methods/clustered_gather/prepared_gather.h"
#include "methods/clustered_gather/sums_cpu.h"

namespace relight::clustered_gather {
namespace {

// Direct light on the gather samples and, filtered to pixels, on the view.
struct DirectLight {
  std::vector<glm::vec4> gather, view;

  int64_t bytes() const { return static_cast<int64_t>((gather.size() + view.size()) * sizeof(glm::vec4)); }
};

// What is lit, and by what; see CachedDirectLight.
struct LitSamples {
  SampleBlocks gather, view;
  BlockLighting lighting;

  LitSamples(const PrepareContext& context, const GatherSamples& samples)
      : gather(samples.samples, sequential_order(samples.samples.size()), context.buffer.view.camera.eye),
        view(context.buffer.direct, pixel_quad_order(context.buffer.view.width, context.buffer.view.height),
             context.buffer.view.camera.eye),
        lighting(context.tracer) {}

  DirectLight make() const {
    return {std::vector<glm::vec4>(gather.count() * block_lanes),
            std::vector<glm::vec4>(view.count() * block_lanes / 4)};
  }
  void shade(const std::vector<Light>& lights, DirectLight& out, Onto onto, StageLog& log) {
    lighting.shade(lights, {{&gather, Lobes::diffuse, 1, out.gather}, {&view, Lobes::all, 4, out.view}}, onto,
                   log);
  }
  void copy(const DirectLight& from, DirectLight& to) const { to = from; }
};

class PreparedGatherCpu : public Prepared {
 public:
  PreparedGatherCpu(const PrepareContext& context, Artefact artefact)
      : samples_(context, artefact.gather),
        direct_(samples_.make()),
        sums_(std::move(artefact), context.buffer),
        reconstruction_(context.buffer) {
    context.log.bytes("gather_samples", samples_.gather.bytes());
    context.log.bytes("view_samples", samples_.view.bytes() + reconstruction_.bytes());
    context.log.bytes("links", sums_.bytes());
    context.log.bytes("partial_results", direct_.bytes());
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
    const DirectLight& direct = direct_.shade(samples_, lighting, log);
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
  LitSamples samples_;
  CachedDirectLight<DirectLight> direct_;
  SumsCpu sums_;
  FusedReconstruction reconstruction_;
};

}  // namespace

std::unique_ptr<Prepared> make_prepared_gather_cpu(const PrepareContext& context, Artefact artefact) {
  if (context.knobs.choice("shadows") == "map")
    fail("clustered_gather.shadows: 'map' needs the GPU; valid with device=cpu: auto, traced");
  return std::make_unique<PreparedGatherCpu>(context, std::move(artefact));
}

}  // namespace relight::clustered_gather
