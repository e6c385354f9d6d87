#include "methods/direct_to_indirect/prepared_transfer_cpu.h"

#include <optional>

#include "common/linalg/partial_product.h"
#include "common/linalg/product_list.h"
#include "common/run/error.h"
#include "common/shading/cached_direct_light.h"
#include "common/shading/fused_reconstruction.h"
#include "common/shading/lit_samples_cpu.h"
#include "common/wavelet/haar_cpu.h"
#include "methods/direct_to_indirect/environment_light_cpu.h"
#include "methods/direct_to_indirect/glossy_lobe.h"
#include "methods/direct_to_indirect/light_points.h"
#include "methods/direct_to_indirect/multi_bounce_light_cpu.h"
#include "methods/direct_to_indirect/transfer_settings.h"
#include "methods/direct_to_indirect/view_basis.h"

namespace relight::direct_to_indirect {
namespace {

class PreparedTransferCpu : public Prepared {
 public:
  PreparedTransferCpu(const PrepareContext& context, const IndirectGrid& grid, Artefact artefact)
      : scene_environment_(context.scene.environment),
        samples_("direct_to_indirect", context.tracer, context.buffer, context.knobs, lit_points(artefact)),
        haar_(artefact.cloud.samples.size()),
        basis_(view_basis(grid, context.knobs)),
        kd_(basis_ ? diffuse_albedo(grid) : std::vector<glm::vec3>{}),
        product_(make_product_cpu(context.knobs.choice("product"), artefact.final_gather.diffuse,
                                  row_factors(grid, basis_.has_value()), picture_shape(grid),
                                  product_settings(context.knobs, grid))),
        glossy_product_(make_glossy_product(context, grid, artefact.final_gather)),
        reconstruction_(context.buffer, grid.upsampling()),
        direct_(samples_.make()),
        means_(artefact.light_points.empty() ? 0 : artefact.cloud.samples.size()),
        coefficients_(artefact.cloud.samples.size()),
        rows_(basis_ ? grid.samples().indirect.size() : 0),
        indirect_(grid.samples().indirect.size()),
        kept_environment_("direct_to_indirect", context.knobs, !artefact.environment.empty()) {
    if (!artefact.environment.empty())
      environment_.emplace(context, grid, std::move(artefact.environment), artefact.cloud);
    if (artefact.multi_bounce.bounces > 1) {
      report_share_beyond(artefact.multi_bounce, context.log);
      bounces_.emplace(std::move(artefact.multi_bounce), artefact.cloud);
      context.log.bytes("multi_bounce_matrix", bounces_->matrix_bytes());
      context.log.bytes("multi_bounce_light", bounces_->result_bytes());
    }
    log_matrices(artefact.final_gather, context.log);
    log_product("transfer", product_->statistics(), context.log);
    if (glossy_product_) log_product("glossy_transfer", glossy_product_->statistics(), context.log);
    context.log.bytes("gather_samples", samples_.gather.bytes());
    context.log.bytes("view_samples", samples_.view.bytes() + reconstruction_.bytes());
    context.log.bytes("partial_results", direct_.bytes() + haar_.bytes() +
                                             static_cast<int64_t>((means_.size() + coefficients_.size() +
                                                                   rows_.size() + indirect_.size()) *
                                                                  sizeof(glm::vec4)));
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
    const bool lit_from_afar =
        kept_environment_.update(lighting.environment_or(scene_environment_),
                                 [&](const Environment& e) { environment_->update(e, log); });
    const LitSamplesCpuResult& direct = direct_.shade(samples_, lighting, log);
    std::span<const glm::vec4> light = std::span(direct.gather).first(coefficients_.size());
    if (!means_.empty()) {
      mean_of_points(direct.gather, means_);
      light = means_;
    }
    if (lit_from_afar) light = environment_->added_to(light);
    if (bounces_) {
      const StageTimer timer(log, "multi_bounce");
      light = bounces_->with_bounces(light);
    }
    {
      const StageTimer timer(log, "wavelet_transform");
      haar_.forward(light, coefficients_);
    }
    {
      const StageTimer timer(log, "transfer");
      product_->multiply(coefficients_, basis_ ? rows_ : indirect_);
    }
    if (basis_) {
      const StageTimer timer(log, "view_basis");
      basis_->inverse(rows_, kd_, indirect_);
    }
    if (glossy_product_) {
      const StageTimer timer(log, "glossy_transfer");
      glossy_product_->add(coefficients_, indirect_);
    }
    FusedReconstruction::Images images = reconstruction_.resolve(direct.view, indirect_, log);
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
  static std::optional<PartialProductCpu> make_glossy_product(const PrepareContext& context,
                                                              const IndirectGrid& grid,
                                                              const FinalGather& matrix) {
    if (matrix.glossy_pixels.empty()) return std::nullopt;
    const std::vector<glm::vec3> kg = glossy_colours(grid.samples(), matrix.glossy_pixels);
    return PartialProductCpu(context.knobs.choice("product"),
                             {matrix.glossy, matrix.glossy_pixels, kg, picture_shape(grid)},
                             product_settings(context.knobs, grid));
  }

  const Environment& scene_environment_;
  LitSamplesCpu samples_;
  wavelet::HaarCpu haar_;
  std::optional<wavelet::PictureHaar> basis_;  // none: rows are view samples
  std::vector<glm::vec3> kd_;                  // with a basis
  std::unique_ptr<TransferProduct> product_;
  std::optional<PartialProductCpu> glossy_product_;  // none without glossy pixels
  FusedReconstruction reconstruction_;
  std::optional<MultiBounceLightCpu> bounces_;  // none with one bounce
  CachedDirectLight<LitSamplesCpuResult> direct_;
  std::vector<glm::vec4> means_;  // of light points
  std::vector<glm::vec4> coefficients_, rows_, indirect_;
  KeptEnvironment kept_environment_;
  std::optional<EnvironmentLightCpu> environment_;  // none unless prepared for
};

}  // namespace

std::unique_ptr<Prepared> make_prepared_transfer_cpu(const PrepareContext& context, Artefact artefact) {
  return std::make_unique<PreparedTransferCpu>(context, IndirectGrid(context.buffer, context.knobs),
                                               std::move(artefact));
}

}  // namespace relight::direct_to_indirect
