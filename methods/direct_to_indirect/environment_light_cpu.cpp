#include "methods/direct_to_indirect/environment_light_cpu.h"

#include "common/linalg/product_list.h"
#include "methods/direct_to_indirect/glossy_lobe.h"
#include "methods/direct_to_indirect/transfer_settings.h"

namespace relight::direct_to_indirect {

EnvironmentLightCpu::EnvironmentLightCpu(const PrepareContext& context, const IndirectGrid& grid,
                                         const EnvironmentTransfer& matrices, const GatherCloud& cloud)
    : square_(matrices.view.columns),
      upsampling_(context.buffer, grid.upsampling()),
      haar_(square_.texels()),
      coefficients_(square_.texels()),
      reflected_(grid.samples().indirect.size()),
      gather_(cloud.samples.size()),
      sum_(cloud.samples.size()) {
  context.log.bytes("environment_matrix", matrices.bytes());
  const std::string& form = context.knobs.choice("product");
  const ProductSettings settings = product_settings(context.knobs, grid);
  view_ = make_product_cpu(form, matrices.view, diffuse_albedo(grid), picture_shape(grid), settings);
  log_product("environment", view_->statistics(), context.log);
  if (matrices.glossy.rows() > 0) {
    const std::vector<uint32_t> pixels = glossy_pixels(grid.samples());
    const std::vector<glm::vec3> kg = glossy_colours(grid.samples(), pixels);
    glossy_.emplace(form, PartialMatrix{matrices.glossy, pixels, kg, picture_shape(grid)}, settings);
    log_product("glossy_environment", glossy_->statistics(), context.log);
  }
  std::vector<glm::vec3> albedo;
  for (const SurfaceSample& s : cloud.samples) albedo.push_back(s.diffuse);
  gather_rows_.emplace(matrices.gather, albedo, WeightFormat::float32);
  context.log.bytes("gather_environment_product", gather_rows_->bytes());
  const size_t values =
      square_.texels() + coefficients_.size() + reflected_.size() + gather_.size() + sum_.size();
  context.log.bytes("environment_light",
                    static_cast<int64_t>(values * sizeof(glm::vec4)) + haar_.bytes() + upsampling_.bytes());
}

void EnvironmentLightCpu::update(const Environment& environment, StageLog& log) {
  const StageTimer timer(log, "environment");
  log.count("environment_updates", 1);
  radiance_.clear();
  for (const glm::dvec3& l : mean_radiance(environment, square_)) radiance_.emplace_back(glm::vec3(l), 0.0f);
  haar_.forward(radiance_, coefficients_);
  view_->multiply(coefficients_, reflected_);
  if (glossy_) glossy_->add(coefficients_, reflected_);
  gather_rows_->multiply(coefficients_, gather_);
  picture_ = upsampling_.resolve(environment, reflected_, log);
}

std::span<const glm::vec4> EnvironmentLightCpu::added_to(std::span<const glm::vec4> direct) {
  for (size_t i = 0; i < sum_.size(); ++i) sum_[i] = direct[i] + gather_[i];
  return sum_;
}

}  // namespace relight::direct_to_indirect
