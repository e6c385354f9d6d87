#include "methods/direct_to_indirect/prepared_transfer.h"

#include <optional>

#include "common/gpu/context.h"
#include "common/gpu/timer.h"
#include "common/linalg/partial_product.h"
#include "common/linalg/product_list.h"
#include "common/shading/cached_direct_light.h"
#include "common/shading/lit_samples.h"
#include "common/shading/reconstruction.h"
#include "common/wavelet/haar.h"
#include "common/wavelet/haar_gpu.h"
#include "common/wavelet/picture_haar_gpu.h"
#include "methods/direct_to_indirect/environment_light.h"
#include "methods/direct_to_indirect/glossy_lobe.h"
#include "methods/direct_to_indirect/light_points.h"
#include "methods/direct_to_indirect/multi_bounce_light.h"
#include "methods/direct_to_indirect/transfer_settings.h"
#include "methods/direct_to_indirect/view_basis.h"

namespace relight::direct_to_indirect {
namespace {

class PreparedTransfer : public Prepared {
 public:
  PreparedTransfer(const PrepareContext& context, const IndirectGrid& grid, Artefact artefact)
      : matrix_(std::move(artefact.final_gather)),
        kd_(diffuse_albedo(grid)),
        kg_(glossy_colours(grid.samples(), matrix_.glossy_pixels)),
        basis_(view_basis(grid, context.knobs)),
        oracle_(context.knobs.choice("device") == "oracle"),
        scene_environment_(context.scene.environment),
        samples_(context.gpu, context.scene, context.tracer, context.buffer, context.knobs,
                 lit_points(artefact)),
        haar_(static_cast<int64_t>(artefact.cloud.samples.size())),
        reconstruction_(context.buffer, grid.upsampling()),
        direct_(samples_.make()),
        indirect_(static_cast<int64_t>(kd_.size()) * 16),
        kept_environment_("direct_to_indirect", context.knobs, !artefact.environment.empty()) {
    if (!artefact.environment.empty())
      environment_.emplace(context, grid, std::move(artefact.environment), artefact.cloud);
    if (!artefact.light_points.empty()) mean_.emplace(artefact.cloud.samples.size());
    if (basis_) {
      inverse_basis_.emplace(*basis_, kd_);
      rows_ = gpu::Buffer(indirect_.bytes());
    }
    if (artefact.multi_bounce.bounces > 1) {
      report_share_beyond(artefact.multi_bounce, context.log);
      bounces_.emplace(std::move(artefact.multi_bounce), artefact.cloud,
                       context.gpu.max_storage_block_bytes());
      context.log.bytes("multi_bounce_matrix", bounces_->matrix_bytes());
      context.log.bytes("multi_bounce_matrix_gpu", bounces_->gpu_bytes());
      context.log.bytes("multi_bounce_light", bounces_->result_bytes());
    }
    make_product(context, grid);
    context.log.bytes("gather_samples", samples_.gather.bytes());
    context.log.bytes("view_samples", samples_.view.bytes());
    context.log.bytes("lighting", samples_.lighting.bytes());
    context.log.bytes("partial_results", direct_.bytes() + indirect_.bytes() + rows_.bytes() +
                                             (inverse_basis_ ? inverse_basis_->bytes() : 0) +
                                             (mean_ ? mean_->bytes() : 0) + haar_.bytes());
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
    const bool lit_from_afar =
        kept_environment_.update(lighting.environment_or(scene_environment_),
                                 [&](const Environment& e) { environment_->update(e, log); });
    const LitSamplesGpuResult& direct = direct_.shade(samples_, lighting, log);
    const gpu::Buffer& light = mean_ ? mean_->mean(direct.gather) : direct.gather;
    if (oracle_)
      transfer_in_double(light, lit_from_afar, log);
    else
      transfer_on_gpu(lit_from_afar ? environment_->added_to(light) : light, log);
    Reconstruction::Images images = reconstruction_.resolve(direct.view, indirect_, log);
    if (lit_from_afar) add_image(environment_->picture(), images.direct);
    return with_total(std::move(images.direct), std::move(images.indirect));
  }
  void forget() override {
    direct_.forget();
    kept_environment_.forget();
  }

 private:
  // Makes the products and lets the matrices go, of which only the oracle needs the floats.
  void make_product(const PrepareContext& context, const IndirectGrid& grid) {
    log_matrices(matrix_, context.log);
    if (oracle_) return;
    const std::string& form = context.knobs.choice("product");
    const PictureShape shape = picture_shape(grid);
    const ProductSettings settings = product_settings(context.knobs, grid);
    const int64_t block = context.gpu.max_storage_block_bytes();
    product_ = make_product_gpu(form, matrix_.diffuse, row_factors(grid, basis_.has_value()), shape, settings,
                                block);
    log_product("transfer", product_->statistics(), context.log);
    if (!kg_.empty()) {
      glossy_product_.emplace(form, PartialMatrix{matrix_.glossy, matrix_.glossy_pixels, kg_, shape},
                              settings, block);
      log_product("glossy_transfer", glossy_product_->statistics(), context.log);
    }
    matrix_ = {};
  }

  void transfer_on_gpu(const gpu::Buffer& gather_direct, StageLog& log) {
    const gpu::Buffer* light = &gather_direct;
    if (bounces_) {
      StageTimer timer(log, "multi_bounce");
      light = &bounces_->with_bounces(gather_direct, haar_);
      gpu::finish();
    }
    {
      StageTimer timer(log, "wavelet_transform");
      haar_.forward(*light);
      gpu::finish();
    }
    {
      StageTimer timer(log, "transfer");
      product_->multiply(haar_.coefficients(), basis_ ? rows_ : indirect_);
      gpu::finish();
    }
    if (inverse_basis_) {
      StageTimer timer(log, "view_basis");
      inverse_basis_->inverse(rows_, indirect_);
      gpu::finish();
    }
    if (glossy_product_) {
      StageTimer timer(log, "glossy_transfer");
      glossy_product_->add(haar_.coefficients(), indirect_);
      gpu::finish();
      const CullStatistics culled = glossy_product_->culled();
      log.count("glossy_transfer_blocks_culled", culled.blocks);
      log.count("glossy_transfer_weights_culled", culled.weights);
    }
    const CullStatistics culled = product_->culled();
    log.count("transfer_blocks_culled", culled.blocks);
    log.count("transfer_weights_culled", culled.weights);
  }

  // The double-precision twin: the oracle of the GPU path.
  void transfer_in_double(const gpu::Buffer& gather_direct, bool lit_from_afar, StageLog& log) {
    std::vector<glm::dvec3> g;
    {
      StageTimer timer(log, "wavelet_transform");
      for (const glm::vec4& v : gather_direct.download<glm::vec4>()) g.emplace_back(v);
    }
    if (lit_from_afar) environment_->add_to(g);
    if (bounces_) {
      StageTimer timer(log, "multi_bounce");
      g = bounces_->with_bounces(g);
    }
    {
      StageTimer timer(log, "wavelet_transform");
      g = wavelet::forward(g);
    }
    StageTimer timer(log, "transfer");
    const std::vector<glm::vec3> sums = relight::multiply(matrix_.diffuse, g);
    std::vector<glm::vec4> v(sums.size());
    if (basis_) {
      std::vector<glm::vec4> rows;
      for (const glm::vec3& s : sums) rows.emplace_back(s, 0.0f);
      basis_->inverse(rows, kd_, v);
    } else {
      for (size_t i = 0; i < v.size(); ++i) v[i] = glm::vec4(sums[i] * kd_[i], 0.0f);
    }
    if (!kg_.empty()) {
      const std::vector<glm::vec3> glossy = relight::multiply(matrix_.glossy, g);
      for (size_t i = 0; i < glossy.size(); ++i)
        v[matrix_.glossy_pixels[i]] += glm::vec4(glossy[i] * kg_[i], 0.0f);
    }
    indirect_.upload(0, indirect_.bytes(), v.data());
  }

  FinalGather matrix_;                         // empty once products are made of it
  std::vector<glm::vec3> kd_, kg_;             // of all pixels, of the glossy ones
  std::optional<wavelet::PictureHaar> basis_;  // none: rows are view samples
  bool oracle_;
  const Environment& scene_environment_;
  LitSamplesGpu samples_;
  std::optional<MeanOfPointsGpu> mean_;  // with light points
  wavelet::HaarGpu haar_;
  Reconstruction reconstruction_;
  std::optional<MultiBounceLight> bounces_;  // none with one bounce
  CachedDirectLight<LitSamplesGpuResult> direct_;
  std::optional<wavelet::PictureHaarGpu> inverse_basis_;
  gpu::Buffer rows_;  // with a basis
  gpu::Buffer indirect_;
  std::unique_ptr<TransferProductGpu> product_;      // none for the oracle
  std::optional<PartialProductGpu> glossy_product_;  // none without glossy pixels
  KeptEnvironment kept_environment_;
  std::optional<EnvironmentLight> environment_;  // none unless prepared for
};

}  // namespace

std::unique_ptr<Prepared> make_prepared_transfer(const PrepareContext& context, Artefact artefact) {
  return std::make_unique<PreparedTransfer>(context, IndirectGrid(context.buffer, context.knobs),
                                            std::move(artefact));
}

}  // namespace relight::direct_to_indirect
