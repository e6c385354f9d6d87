#include "methods/direct_to_indirect/prepared_transfer.h"

#include <algorithm>
#include <optional>

#include "common/gpu/context.h"
#include "common/gpu/timer.h"
#include "common/linalg/product_list.h"
#include "common/shading/direct_lighting.h"
#include "common/shading/reconstruction.h"
#include "common/wavelet/haar.h"
#include "common/wavelet/haar_gpu.h"
#include "methods/direct_to_indirect/multi_bounce_light.h"

namespace relight::direct_to_indirect {
namespace {

std::vector<glm::vec3> diffuse_albedo(const DeepFrameBuffer& buffer) {
  std::vector<glm::vec3> kd(buffer.indirect.size());
  std::transform(buffer.indirect.begin(), buffer.indirect.end(), kd.begin(),
                 [](const SurfaceSample& s) { return s.diffuse; });
  return kd;
}

enum class Device { gpu, cpu, oracle };

Device device_of(const KnobValues& knobs) {
  const std::string& name = knobs.choice("device");
  return name == "gpu" ? Device::gpu : name == "cpu" ? Device::cpu : Device::oracle;
}

ProductSettings product_settings(const KnobValues& knobs) {
  ProductSettings settings;
  settings.weights = weight_format_from_string(knobs.choice("weights"));
  settings.partial_results =
      knobs.choice("partial_results") == "float16" ? PartialResults::float16 : PartialResults::float32;
  settings.cull_epsilon = static_cast<float>(knobs.real("cull_epsilon"));
  settings.block_waste = static_cast<float>(knobs.real("block_waste"));
  return settings;
}

class PreparedTransfer : public Prepared {
 public:
  PreparedTransfer(const PrepareContext& context, Artefact artefact)
      : matrix_(std::move(artefact.final_gather)),
        kd_(diffuse_albedo(context.buffer)),
        device_(device_of(context.knobs)),
        gather_(artefact.cloud.samples, context.buffer.view.camera.eye),
        view_(context.buffer.direct, context.buffer.view.camera.eye),
        lighting_(context.gpu, context.scene, context.tracer,
                  {context.knobs.choice("shadows") == "map" ? Shadows::map : Shadows::traced,
                   static_cast<int>(context.knobs.integer("shadow_map_size"))}),
        haar_(static_cast<int64_t>(artefact.cloud.samples.size())),
        reconstruction_(context.buffer),
        gather_direct_(static_cast<int64_t>(gather_.size()) * 16),
        view_direct_(static_cast<int64_t>(view_.size()) * 16),
        indirect_(static_cast<int64_t>(kd_.size()) * 16) {
    if (artefact.multi_bounce.bounces > 1) {
      report_share_beyond(artefact.multi_bounce, context.log);
      bounces_.emplace(std::move(artefact.multi_bounce), artefact.cloud,
                       context.gpu.max_storage_block_bytes());
      context.log.bytes("multi_bounce_matrix", bounces_->matrix_bytes());
      context.log.bytes("multi_bounce_matrix_gpu", bounces_->gpu_bytes());
      context.log.bytes("multi_bounce_light", bounces_->result_bytes());
    }
    make_product(context);
    context.log.bytes("gather_samples", gather_.bytes());
    context.log.bytes("view_samples", view_.bytes());
    context.log.bytes("lighting", lighting_.bytes());
    context.log.bytes("partial_results",
                      gather_direct_.bytes() + view_direct_.bytes() + indirect_.bytes() + haar_.bytes());
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
    lighting_.shade(lighting,
                    {{&gather_, Lobes::diffuse, &gather_direct_}, {&view_, Lobes::all, &view_direct_}}, log);
    if (device_ == Device::gpu)
      transfer_on_gpu(log);
    else
      transfer_on_cpu(log);
    Reconstruction::Images images = reconstruction_.resolve(view_direct_, indirect_, log);
    Relit out{std::move(images.direct), std::move(images.indirect), {}};
    out.total = out.direct;
    for (size_t i = 0; i < out.total.pixels.size(); ++i) out.total.pixels[i] += out.indirect.pixels[i];
    return out;
  }

 private:
  // Makes the product of the device and lets the matrix go, of which only the oracle needs the floats.
  void make_product(const PrepareContext& context) {
    context.log.bytes("final_gather_matrix", matrix_.bytes());
    if (device_ == Device::oracle) return;
    const std::string& form = context.knobs.choice("product");
    const View& view = context.buffer.view;
    const PictureShape shape{view.width, view.height};
    const ProductSettings settings = product_settings(context.knobs);
    if (device_ == Device::gpu)
      gpu_product_ =
          make_product_gpu(form, matrix_, kd_, shape, settings, context.gpu.max_storage_block_bytes());
    else
      cpu_product_ = make_product_cpu(form, matrix_, kd_, shape, settings);
    matrix_ = {};
    const ProductStatistics s = gpu_product_ ? gpu_product_->statistics() : cpu_product_->statistics();
    context.log.bytes("transfer_product", s.bytes);
    context.log.count("transfer_weights_stored", s.stored);
    context.log.count("transfer_blocks", s.blocks);
    context.log.count("transfer_atlases", s.atlases);
  }

  void transfer_on_gpu(StageLog& log) {
    const gpu::Buffer* light = &gather_direct_;
    if (bounces_) {
      StageTimer timer(log, "multi_bounce");
      light = &bounces_->with_bounces(gather_direct_, haar_);
      gpu::finish();
    }
    {
      StageTimer timer(log, "wavelet_transform");
      haar_.forward(*light);
      gpu::finish();
    }
    {
      StageTimer timer(log, "transfer");
      gpu_product_->multiply(haar_.coefficients(), indirect_);
      gpu::finish();
    }
    const CullStatistics culled = gpu_product_->culled();
    log.count("transfer_blocks_culled", culled.blocks);
    log.count("transfer_weights_culled", culled.weights);
  }

  // The transform in double precision, then the CPU's product, or the double-precision oracle of both
  // devices.
  void transfer_on_cpu(StageLog& log) {
    std::vector<glm::dvec3> g;
    {
      StageTimer timer(log, "wavelet_transform");
      for (const glm::vec4& v : gather_direct_.download<glm::vec4>()) g.emplace_back(v);
    }
    if (bounces_) {
      StageTimer timer(log, "multi_bounce");
      g = bounces_->with_bounces(g);
    }
    {
      StageTimer timer(log, "wavelet_transform");
      g = wavelet::forward(g);
    }
    StageTimer timer(log, "transfer");
    std::vector<glm::vec4> v(kd_.size());
    if (cpu_product_) {
      std::vector<glm::vec4> lights;
      for (const glm::dvec3& light : g) lights.emplace_back(glm::vec3(light), 0.0f);
      cpu_product_->multiply(lights, v);
    } else {
      const std::vector<glm::vec3> sums = relight::multiply(matrix_, g);
      for (size_t i = 0; i < v.size(); ++i) v[i] = glm::vec4(sums[i] * kd_[i], 0.0f);
    }
    indirect_.upload(0, indirect_.bytes(), v.data());
  }

  SparseRows matrix_;  // empty once a product is made of it
  std::vector<glm::vec3> kd_;
  Device device_;
  GpuSamples gather_, view_;
  DirectLighting lighting_;
  wavelet::HaarGpu haar_;
  Reconstruction reconstruction_;
  std::optional<MultiBounceLight> bounces_;  // none with one bounce
  gpu::Buffer gather_direct_, view_direct_, indirect_;
  std::unique_ptr<TransferProductGpu> gpu_product_;  // of the device; neither for the oracle
  std::unique_ptr<TransferProduct> cpu_product_;
};

}  // namespace

std::unique_ptr<Prepared> make_prepared_transfer(const PrepareContext& context, Artefact artefact) {
  return std::make_unique<PreparedTransfer>(context, std::move(artefact));
}

}  // namespace relight::direct_to_indirect
