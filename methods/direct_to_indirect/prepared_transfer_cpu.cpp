#include "methods/direct_to_indirect/prepared_transfer_cpu.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "common/run/error.h"
#include "common/shading/block_lighting.h"
#include "common/shading/fused_reconstruction.h"
#include "common/shading/light_cache.h"
#include "common/wavelet/haar_cpu.h"

namespace relight::direct_to_indirect {
namespace {

std::vector<glm::vec3> diffuse_albedo(const DeepFrameBuffer& buffer) {
  std::vector<glm::vec3> kd(buffer.indirect.size());
  std::transform(buffer.indirect.begin(), buffer.indirect.end(), kd.begin(),
                 [](const SurfaceSample& s) { return s.diffuse; });
  return kd;
}

class RowProduct {
 public:
  RowProduct(SparseRows m, std::vector<glm::vec3> kd) : m_(std::move(m)), kd_(std::move(kd)) {}
  void multiply(std::span<const glm::vec4> x, std::span<glm::vec4> y) const {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, m_.rows(), 256), [&](const auto& range) {
      for (size_t row = range.begin(); row < range.end(); ++row) {
        glm::vec4 sum(0.0f);
        for (uint64_t e = m_.row_start[row]; e < m_.row_start[row + 1]; ++e)
          sum += m_.entries[e].value * x[m_.entries[e].column];
        y[row] = sum * glm::vec4(kd_[row], 0.0f);
      }
    });
  }
  int64_t bytes() const { return m_.bytes(); }

 private:
  SparseRows m_;
  std::vector<glm::vec3> kd_;
};

// Direct light on the gather samples and, filtered to pixels, on the view.
struct DirectLight {
  std::vector<glm::vec4> gather, view;

  int64_t bytes() const { return static_cast<int64_t>((gather.size() + view.size()) * sizeof(glm::vec4)); }
};

class PreparedTransferCpu : public Prepared {
 public:
  PreparedTransferCpu(const PrepareContext& context, Artefact artefact)
      : gather_(artefact.cloud.samples, sequential_order(artefact.cloud.samples.size()), eye(context)),
        view_(context.buffer.direct, pixel_quad_order(context.buffer.view.width, context.buffer.view.height),
              eye(context)),
        lighting_(context.tracer),
        haar_(artefact.cloud.samples.size()),
        product_(std::move(artefact.final_gather), diffuse_albedo(context.buffer)),
        reconstruction_(context.buffer),
        direct_(black()),
        coefficients_(artefact.cloud.samples.size()),
        indirect_(context.buffer.indirect.size()) {
    context.log.bytes("final_gather_matrix", product_.bytes());
    context.log.bytes("gather_samples", gather_.bytes());
    context.log.bytes("view_samples", view_.bytes() + reconstruction_.bytes());
    context.log.bytes("partial_results", direct_.bytes() + haar_.bytes() +
                                             static_cast<int64_t>((coefficients_.size() + indirect_.size()) *
                                                                  sizeof(glm::vec4)));
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
    const DirectLight& direct = shade(lighting, log);
    {
      const StageTimer timer(log, "wavelet_transform");
      haar_.forward(std::span(direct.gather).first(coefficients_.size()), coefficients_);
    }
    {
      const StageTimer timer(log, "transfer");
      product_.multiply(coefficients_, indirect_);
    }
    FusedReconstruction::Images images = reconstruction_.resolve(direct.view, indirect_, log);
    return {std::move(images.direct), std::move(images.indirect), std::move(images.total)};
  }

 private:
  static const glm::vec3& eye(const PrepareContext& context) { return context.buffer.view.camera.eye; }

  DirectLight black() const {
    return {std::vector<glm::vec4>(gather_.count() * block_lanes),
            std::vector<glm::vec4>(view_.count() * block_lanes / 4)};
  }

  const DirectLight& shade(const LightingState& lighting, StageLog& log) {
    for (const Light& light : lighting.lights) require_omni_or_spot(light);
    const LightCache::Plan plan = cache_.plan(lighting);
    if (plan.uses_sum()) {
      if (kept_.gather.empty()) kept_ = black();
      shade(plan.into_sum, kept_, plan.from_zero, log);
      if (!plan.on_top.empty()) direct_ = kept_;
    }
    if (!plan.uses_sum() || !plan.on_top.empty()) shade(plan.on_top, direct_, !plan.uses_sum(), log);
    cache_.done();
    log.count("lights_shaded", plan.shaded());
    log.count("lights_cached", plan.cached);
    return plan.on_top.empty() && plan.uses_sum() ? kept_ : direct_;
  }

  void shade(const std::vector<Light>& lights, DirectLight& out, bool from_zero, StageLog& log) {
    using Onto = BlockLighting::Onto;
    lighting_.shade(lights, {{&gather_, Lobes::diffuse, 1, out.gather}, {&view_, Lobes::all, 4, out.view}},
                    from_zero ? Onto::nothing : Onto::what_is_there, log);
  }

  SampleBlocks gather_, view_;
  BlockLighting lighting_;
  wavelet::HaarCpu haar_;
  RowProduct product_;
  FusedReconstruction reconstruction_;
  LightCache cache_;
  DirectLight direct_, kept_;  // kept_: the sum of lights that LightCache keeps; empty until needed
  std::vector<glm::vec4> coefficients_, indirect_;
};

}  // namespace

std::unique_ptr<Prepared> make_prepared_transfer_cpu(const PrepareContext& context, Artefact artefact) {
  if (context.knobs.choice("shadows") == "map")
    fail("direct_to_indirect.shadows: 'map' needs the GPU; valid with device=cpu: auto, traced");
  return std::make_unique<PreparedTransferCpu>(context, std::move(artefact));
}

}  // namespace relight::direct_to_indirect
