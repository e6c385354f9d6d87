#include "methods/clustered_gather/prepared_gather.h"

#include "common/gpu/context.h"
#include "common/gpu/program.h"
#include "common/gpu/texel_view.h"
#include "common/gpu/timer.h"
#include "common/shading/cached_direct_light.h"
#include "common/shading/kept_environment.h"
#include "common/shading/lit_samples.h"
#include "common/shading/reconstruction.h"
#include "methods/clustered_gather/environment_light.h"
#include "methods/clustered_gather/storage.h"
#include "methods/clustered_gather/sums_cpu.h"

namespace relight::clustered_gather {
namespace {

// The links of one part on the GPU, two a texel, the last of an odd number with weight 0.
class GpuLinks {
 public:
  GpuLinks(const Links& links, Part part, SampleFormat format)
      : links_(gpu::Buffer::from(pack_links(links, format))),
        texel_(format == SampleFormat::full ? gpu::TexelView::Format::rgba32ui
                                            : gpu::TexelView::Format::rgb32ui),
        pixel_(gpu::Buffer::from(links.pixel)),
        program_(gpu::Program::compute("methods/clustered_gather/links.glsl",
                                       {part == Part::diffuse ? "DIFFUSE 1" : "DIFFUSE 0",
                                        format == SampleFormat::full ? "HALF 0" : "HALF 1"})),
        pixels_(links.pixel.size()),
        texels_per_pixel_((links.per_pixel + 1) / 2) {}

  void interpolate(const gpu::Buffer& gathered, const gpu::Buffer& albedo,
                   const gpu::Buffer& indirect) const {
    using enum gpu::TexelView::Format;
    if (pixels_ == 0) return;
    const gpu::TexelView links(links_, texel_), from(gathered, rgba32f), factor(albedo, rgba32f);
    program_.use();
    links.bind(0), from.bind(1), factor.bind(2);
    indirect.bind_storage(3);
    pixel_.bind_storage(4);
    program_.set("pixels", static_cast<uint32_t>(pixels_));
    program_.set("texels_per_pixel", texels_per_pixel_);
    program_.dispatch_items(static_cast<int64_t>(pixels_), 64);
  }
  int64_t bytes() const { return links_.bytes() + pixel_.bytes(); }

 private:
  gpu::Buffer links_;
  gpu::TexelView::Format texel_;
  gpu::Buffer pixel_;
  gpu::Program program_;
  size_t pixels_;
  uint32_t texels_per_pixel_;
};

std::vector<glm::vec4> albedo(const DeepFrameBuffer& buffer) {
  std::vector<glm::vec4> kd;
  for (const SurfaceSample& s : buffer.indirect) kd.emplace_back(s.diffuse, 0.0f);
  return kd;
}

class PreparedGather : public Prepared {
 public:
  PreparedGather(const PrepareContext& context, Artefact artefact)
      : oracle_(context.knobs.choice("device") == "oracle"),
        scene_environment_(context.scene.environment),
        kept_environment_("clustered_gather", context.knobs, artefact.gather.environment.columns > 0),
        environment_(make_environment_light(context, artefact.gather, !oracle_)),
        samples_(
            context.gpu, context.scene, context.tracer, context.buffer, context.knobs,
            gpu_samples(artefact.gather.samples, context.buffer.view.camera.eye, storage(context.knobs))),
        direct_(samples_.make()),
        first_(gpu::Buffer::from(artefact.gather.first)),
        albedo_(gpu::Buffer::from(albedo(context.buffer))),
        gathered_(static_cast<int64_t>(std::max<size_t>(artefact.gather.first.size() - 1, 1)) * 16),
        indirect_(static_cast<int64_t>(context.buffer.indirect.size()) * 16),
        sum_(gpu::Program::compute("methods/clustered_gather/indirect_sum.glsl")),
        reconstruction_(context.buffer),
        clusters_(artefact.gather.first.size() - 1) {
    const SampleFormat format = storage(context.knobs);
    round_weights(artefact.diffuse, format), round_weights(artefact.glossy, format);
    links_.emplace_back(artefact.diffuse, Part::diffuse, format);
    if (!artefact.glossy.pixel.empty()) links_.emplace_back(artefact.glossy, Part::glossy, format);
    int64_t link_bytes = first_.bytes();
    for (const GpuLinks& l : links_) link_bytes += l.bytes();
    if (oracle_) host_ = {std::move(artefact), context.buffer};
    context.log.bytes("gather_samples", samples_.gather.bytes());
    context.log.bytes("view_samples", samples_.view.bytes() + albedo_.bytes());
    context.log.bytes("links", link_bytes);
    context.log.bytes("lighting", samples_.lighting.bytes());
    context.log.bytes("partial_results", direct_.bytes() + gathered_.bytes() + indirect_.bytes());
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
    const bool lit_from_afar =
        kept_environment_.update(lighting.environment_or(scene_environment_),
                                 [&](const Environment& e) { update_environment(e, log); });
    const LitSamplesGpuResult& direct = direct_.shade(samples_, lighting, log);
    if (oracle_)
      sum_in_double(direct.gather, log);
    else
      sum_on_gpu(direct.gather, log);
    Reconstruction::Images images = reconstruction_.resolve(direct.view, indirect_, log);
    if (lit_from_afar) add_image(environment_->picture(), images.direct);
    return with_total(std::move(images.direct), std::move(images.indirect));
  }
  void forget() override {
    direct_.forget();
    kept_environment_.forget();
  }

 private:
  void update_environment(const Environment& environment, StageLog& log) {
    const EnvironmentLight::InterpolateCpu in_double = [&](const std::vector<glm::dvec3>& gathered) {
      return host_.interpolate<double>(gathered);
    };
    const EnvironmentLight::InterpolateGpu on_gpu =
        [&](const gpu::Buffer& gathered, const gpu::Buffer& pixels) { interpolate(gathered, pixels); };
    if (oracle_)
      environment_->update(environment, in_double, log);
    else
      environment_->update(environment, on_gpu, log);
  }

  void interpolate(const gpu::Buffer& gathered, const gpu::Buffer& pixels) const {
    pixels.clear();
    for (const GpuLinks& l : links_) l.interpolate(gathered, albedo_, pixels);
  }

  void sum_on_gpu(const gpu::Buffer& radiance, StageLog& log) {
    {
      StageTimer timer(log, "indirect_sum");
      const gpu::TexelView view(radiance, gpu::TexelView::Format::rgba32f);
      sum_.use();
      first_.bind_storage(0);
      view.bind(1);
      gathered_.bind_storage(2);
      sum_.set("clusters", static_cast<uint32_t>(clusters_));
      sum_.dispatch_items(static_cast<int64_t>(clusters_), 64);
      gpu::finish();
    }
    StageTimer timer(log, "links");
    interpolate(gathered_, indirect_);
    gpu::finish();
  }

  // The double-precision twin: the oracle of the GPU path.
  void sum_in_double(const gpu::Buffer& radiance, StageLog& log) {
    StageTimer timer(log, "indirect_sum");
    const std::vector<glm::vec4> v = host_.indirect<double>(radiance.download<glm::vec4>());
    indirect_.upload(0, indirect_.bytes(), v.data());
  }

  bool oracle_;
  const Environment& scene_environment_;
  KeptEnvironment kept_environment_;
  std::optional<EnvironmentLight> environment_;  // none unless prepared for
  SumsCpu host_;                                 // of the oracle only
  LitSamplesGpu samples_;
  CachedDirectLight<LitSamplesGpuResult> direct_;
  gpu::Buffer first_, albedo_, gathered_, indirect_;
  gpu::Program sum_;
  std::vector<GpuLinks> links_;
  Reconstruction reconstruction_;
  size_t clusters_;
};

}  // namespace

std::unique_ptr<Prepared> make_prepared_gather(const PrepareContext& context, Artefact artefact) {
  return std::make_unique<PreparedGather>(context, std::move(artefact));
}

}  // namespace relight::clustered_gather
