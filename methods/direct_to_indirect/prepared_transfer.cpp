#include "methods/direct_to_indirect/prepared_transfer.h"

#include <algorithm>

#include "common/gpu/context.h"
#include "common/gpu/timer.h"
#include "common/linalg/sparse_product_gpu.h"
#include "common/shading/direct_lighting.h"
#include "common/shading/reconstruction.h"
#include "common/wavelet/haar.h"
#include "common/wavelet/haar_gpu.h"

namespace relight::direct_to_indirect {
namespace {

std::vector<glm::vec3> diffuse_albedo(const DeepFrameBuffer& buffer) {
  std::vector<glm::vec3> kd(buffer.indirect.size());
  std::transform(buffer.indirect.begin(), buffer.indirect.end(), kd.begin(),
                 [](const SurfaceSample& s) { return s.diffuse; });
  return kd;
}

class PreparedTransfer : public Prepared {
 public:
  PreparedTransfer(const PrepareContext& context, Artefact artefact)
      : matrix_(std::move(artefact.final_gather)),
        kd_(diffuse_albedo(context.buffer)),
        oracle_(context.knobs.choice("device") == "oracle"),
        gather_(artefact.cloud.samples, context.buffer.view.camera.eye),
        view_(context.buffer.direct, context.buffer.view.camera.eye),
        lighting_(context.gpu, context.scene, context.tracer,
                  {context.knobs.choice("shadows") == "traced" ? Shadows::traced : Shadows::map,
                   static_cast<int>(context.knobs.integer("shadow_map_size"))}),
        haar_(static_cast<int64_t>(artefact.cloud.samples.size())),
        product_(matrix_, kd_, context.gpu.max_storage_block_bytes()),
        reconstruction_(context.buffer),
        gather_direct_(static_cast<int64_t>(gather_.size()) * 16),
        view_direct_(static_cast<int64_t>(view_.size()) * 16),
        indirect_(static_cast<int64_t>(kd_.size()) * 16) {
    context.log.bytes("final_gather_matrix", matrix_.bytes());
    context.log.bytes("final_gather_matrix_gpu", product_.bytes());
    context.log.bytes("gather_samples", gather_.bytes());
    context.log.bytes("view_samples", view_.bytes());
    context.log.bytes("lighting", lighting_.bytes());
    context.log.bytes("partial_results",
                      gather_direct_.bytes() + view_direct_.bytes() + indirect_.bytes() + haar_.bytes());
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
    lighting_.shade(lighting,
                    {{&gather_, Lobes::diffuse, &gather_direct_}, {&view_, Lobes::all, &view_direct_}}, log);
    if (oracle_)
      transfer_in_double(log);
    else
      transfer_on_gpu(log);
    Reconstruction::Images images = reconstruction_.resolve(view_direct_, indirect_, log);
    Relit out{std::move(images.direct), std::move(images.indirect), {}};
    out.total = out.direct;
    for (size_t i = 0; i < out.total.pixels.size(); ++i) out.total.pixels[i] += out.indirect.pixels[i];
    return out;
  }

 private:
  void transfer_on_gpu(StageLog& log) {
    {
      StageTimer timer(log, "wavelet_transform");
      haar_.forward(gather_direct_);
      gpu::finish();
    }
    StageTimer timer(log, "transfer");
    product_.multiply(haar_.coefficients(), indirect_);
    gpu::finish();
  }

  // The double-precision twin: the oracle of the GPU path.
  void transfer_in_double(StageLog& log) {
    std::vector<glm::dvec3> g;
    {
      StageTimer timer(log, "wavelet_transform");
      for (const glm::vec4& v : gather_direct_.download<glm::vec4>()) g.emplace_back(v);
      g = wavelet::forward(g);
    }
    StageTimer timer(log, "transfer");
    const std::vector<glm::vec3> sums = relight::multiply(matrix_, g);
    std::vector<glm::vec4> v(sums.size());
    for (size_t i = 0; i < v.size(); ++i) v[i] = glm::vec4(sums[i] * kd_[i], 0.0f);
    indirect_.upload(0, indirect_.bytes(), v.data());
  }

  SparseRows matrix_;
  std::vector<glm::vec3> kd_;
  bool oracle_;
  GpuSamples gather_, view_;
  DirectLighting lighting_;
  wavelet::HaarGpu haar_;
  SparseProductGpu product_;
  Reconstruction reconstruction_;
  gpu::Buffer gather_direct_, view_direct_, indirect_;
};

}  // namespace

std::unique_ptr<Prepared> make_prepared_transfer(const PrepareContext& context, Artefact artefact) {
  return std::make_unique<PreparedTransfer>(context, std::move(artefact));
}

}  // namespace relight::direct_to_indirect
