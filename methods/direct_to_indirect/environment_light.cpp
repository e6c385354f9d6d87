#include "methods/direct_to_indirect/environment_light.h"

#include "common/gpu/context.h"
#include "common/gpu/timer.h"
#include "common/linalg/product_list.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/glossy_lobe.h"
#include "methods/direct_to_indirect/transfer_settings.h"

namespace relight::direct_to_indirect {

EnvironmentLight::EnvironmentLight(const PrepareContext& context, const IndirectGrid& grid,
                                   EnvironmentTransfer matrices, const GatherCloud& cloud)
    : oracle_(context.knobs.choice("device") == "oracle"),
      square_(matrices.view.columns),
      matrices_(std::move(matrices)),
      kd_(diffuse_albedo(grid)),
      upsampling_(context.buffer, grid.upsampling()),
      haar_(square_.texels()),
      radiance_(int64_t{16} * square_.texels()),
      reflected_(static_cast<int64_t>(kd_.size()) * 16),
      gather_(static_cast<int64_t>(cloud.samples.size()) * 16),
      sum_(gather_.bytes()) {
  for (const SurfaceSample& s : cloud.samples) albedo_.push_back(s.diffuse);
  if (matrices_.glossy.rows() > 0) glossy_pixels_ = glossy_pixels(grid.samples());
  kg_ = glossy_colours(grid.samples(), glossy_pixels_);
  context.log.bytes("environment_matrix", matrices_.bytes());
  if (!oracle_) {
    const std::string& form = context.knobs.choice("product");
    const PictureShape shape = picture_shape(grid);
    const ProductSettings settings = product_settings(context.knobs, grid);
    const int64_t block = context.gpu.max_storage_block_bytes();
    view_ = make_product_gpu(form, matrices_.view, kd_, shape, settings, block);
    log_product("environment", view_->statistics(), context.log);
    if (!kg_.empty()) {
      glossy_.emplace(form, PartialMatrix{matrices_.glossy, glossy_pixels_, kg_, shape}, settings, block);
      log_product("glossy_environment", glossy_->statistics(), context.log);
    }
    gather_rows_.emplace(matrices_.gather, albedo_, block);
    context.log.bytes("gather_environment_product", gather_rows_->bytes());
    matrices_ = {};
    kd_ = kg_ = albedo_ = {};
  }
  context.log.bytes("environment_light", radiance_.bytes() + reflected_.bytes() + gather_.bytes() +
                                             sum_.bytes() + haar_.bytes() + upsampling_.bytes());
}

void EnvironmentLight::update(const Environment& environment, StageLog& log) {
  const StageTimer timer(log, "environment");
  log.count("environment_updates", 1);
  const std::vector<glm::dvec3> radiance = mean_radiance(environment, square_);
  if (oracle_)
    update_in_double(radiance);
  else
    update_on_gpu(radiance);
  picture_ = upsampling_.resolve(environment, reflected_.download<glm::vec4>(), log);
}

void EnvironmentLight::update_on_gpu(const std::vector<glm::dvec3>& radiance) {
  std::vector<glm::vec4> values;
  for (const glm::dvec3& l : radiance) values.emplace_back(glm::vec3(l), 0.0f);
  radiance_.upload(0, radiance_.bytes(), values.data());
  haar_.forward(radiance_);
  view_->multiply(haar_.coefficients(), reflected_);
  if (glossy_) glossy_->add(haar_.coefficients(), reflected_);
  gather_rows_->multiply(haar_.coefficients(), gather_);
  gpu::finish();
}

void EnvironmentLight::update_in_double(const std::vector<glm::dvec3>& radiance) {
  const std::vector<glm::dvec3> coefficients = wavelet::forward(radiance);
  const std::vector<glm::vec3> diffuse = relight::multiply(matrices_.view, coefficients);
  std::vector<glm::vec4> reflected;
  for (size_t i = 0; i < diffuse.size(); ++i) reflected.emplace_back(diffuse[i] * kd_[i], 0.0f);
  if (!kg_.empty()) {
    const std::vector<glm::vec3> glossy = relight::multiply(matrices_.glossy, coefficients);
    for (size_t i = 0; i < glossy.size(); ++i)
      reflected[glossy_pixels_[i]] += glm::vec4(glossy[i] * kg_[i], 0.0f);
  }
  reflected_.upload(0, reflected_.bytes(), reflected.data());
  gather_in_double_.clear();
  const std::vector<glm::vec3> arriving = relight::multiply(matrices_.gather, coefficients);
  for (size_t i = 0; i < arriving.size(); ++i)
    gather_in_double_.push_back(glm::dvec3(albedo_[i]) * glm::dvec3(arriving[i]));
}

const gpu::Buffer& EnvironmentLight::added_to(const gpu::Buffer& direct) const {
  sum_.copy_from(direct);
  vector_sum_.add(gather_, sum_);
  return sum_;
}

void EnvironmentLight::add_to(std::vector<glm::dvec3>& direct) const {
  for (size_t i = 0; i < direct.size(); ++i) direct[i] += gather_in_double_[i];
}

}  // namespace relight::direct_to_indirect
