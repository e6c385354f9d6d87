#include "common/shading/direct_only.h"

#include "common/shading/cached_direct_light.h"
#include "common/shading/fused_reconstruction.h"
#include "common/shading/lit_samples.h"
#include "common/shading/lit_samples_cpu.h"

namespace relight {

namespace {

// No gather samples at all.
const std::vector<SurfaceSample> none;

struct ViewLightGpu {
  gpu::Buffer view;
  int64_t bytes() const { return view.bytes(); }
};

struct ViewShaderGpu {
  LitSamplesGpu& samples;
  ViewLightGpu make() const { return {gpu::Buffer(static_cast<int64_t>(samples.view.size()) * 16)}; }
  void shade(const std::vector<Light>& lights, ViewLightGpu& out, Onto onto, StageLog& log) {
    samples.lighting.shade(lights, {{&samples.view, Lobes::all, &out.view}}, onto, log);
  }
  void copy(const ViewLightGpu& from, ViewLightGpu& to) const { to.view.copy_from(from.view); }
};

class DirectOnlyGpu : public Prepared {
 public:
  explicit DirectOnlyGpu(const PrepareContext& context)
      : samples_(context.gpu, context.scene, context.tracer, context.buffer, context.knobs, none),
        shader_{samples_},
        direct_(shader_.make()),
        black_(static_cast<int64_t>(context.buffer.indirect.size()) * 16),
        reconstruction_(context.buffer) {
    black_.clear();
    context.log.bytes("view_samples", samples_.view.bytes());
    context.log.bytes("lighting", samples_.lighting.bytes());
    context.log.bytes("partial_results", direct_.bytes());
  }
  Relit relight(const LightingState& lighting, StageLog& log) override {
    const ViewLightGpu& direct = direct_.shade(shader_, lighting, log);
    Reconstruction::Images images = reconstruction_.resolve(direct.view, black_, log);
    return with_total(std::move(images.direct), std::move(images.indirect));
  }
  void forget() override { direct_.forget(); }

 private:
  LitSamplesGpu samples_;
  ViewShaderGpu shader_;
  CachedDirectLight<ViewLightGpu> direct_;
  gpu::Buffer black_;
  Reconstruction reconstruction_;
};

struct ViewShaderCpu {
  LitSamplesCpu& samples;
  LitSamplesCpuResult make() const {
    return {{}, std::vector<glm::vec4>(samples.view.count() * block_lanes / 4)};
  }
  void shade(const std::vector<Light>& lights, LitSamplesCpuResult& out, Onto onto, StageLog& log) {
    samples.lighting.shade(lights, {{&samples.view, Lobes::all, 4, out.view}}, onto, log);
  }
  void copy(const LitSamplesCpuResult& from, LitSamplesCpuResult& to) const { to = from; }
};

class DirectOnlyCpu : public Prepared {
 public:
  DirectOnlyCpu(const std::string& method, const PrepareContext& context)
      : samples_(method, context.tracer, context.buffer, context.knobs, none),
        shader_{samples_},
        direct_(shader_.make()),
        black_(context.buffer.indirect.size(), glm::vec4(0.0f)),
        reconstruction_(context.buffer) {
    context.log.bytes("view_samples", samples_.view.bytes() + reconstruction_.bytes());
    context.log.bytes("partial_results", direct_.bytes());
  }
  Relit relight(const LightingState& lighting, StageLog& log) override {
    const LitSamplesCpuResult& direct = direct_.shade(shader_, lighting, log);
    FusedReconstruction::Images images = reconstruction_.resolve(direct.view, black_, log);
    return {std::move(images.direct), std::move(images.indirect), std::move(images.total)};
  }
  void forget() override { direct_.forget(); }

 private:
  LitSamplesCpu samples_;
  ViewShaderCpu shader_;
  CachedDirectLight<LitSamplesCpuResult> direct_;
  std::vector<glm::vec4> black_;
  FusedReconstruction reconstruction_;
};

}  // namespace

std::unique_ptr<Prepared> make_direct_only(const std::string& method, const PrepareContext& context) {
  if (context.knobs.choice("device") == "cpu") return std::make_unique<DirectOnlyCpu>(method, context);
  return std::make_unique<DirectOnlyGpu>(context);
}

}  // namespace relight
