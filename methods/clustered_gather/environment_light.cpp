#include "methods/clustered_gather/environment_light.h"

#include <algorithm>

#include "common/gpu/context.h"
#include "common/gpu/timer.h"

namespace relight::clustered_gather {

EnvironmentLight::EnvironmentLight(const PrepareContext& context, SparseRowsRgb rows, bool gpu)
    : rows_(std::move(rows)),
      square_(context.knobs.integer("environment_samples")),
      upsampling_(context.buffer) {
  context.log.bytes("environment_samples", rows_.bytes());
  int64_t bytes = upsampling_.bytes();
  if (gpu) {
    product_.emplace(rows_, context.gpu.max_storage_block_bytes());
    radiance_.emplace(int64_t{16} * rows_.columns);
    gathered_.emplace(static_cast<int64_t>(std::max<size_t>(rows_.rows(), 1)) * 16);
    pixels_.emplace(static_cast<int64_t>(context.buffer.indirect.size()) * 16);
    bytes += product_->bytes() + radiance_->bytes() + gathered_->bytes() + pixels_->bytes();
    rows_ = {};
  }
  context.log.bytes("environment_light", bytes);
}

void EnvironmentLight::update(const Environment& environment, const InterpolateGpu& interpolate,
                              StageLog& log) {
  const StageTimer timer(log, "environment");
  log.count("environment_updates", 1);
  std::vector<glm::vec4> nodes;
  for (const glm::dvec3& l : radiance_pyramid(mean_radiance(environment, square_)))
    nodes.emplace_back(glm::vec3(l), 0.0f);
  radiance_->upload(0, radiance_->bytes(), nodes.data());
  product_->multiply(*radiance_, *gathered_);
  interpolate(*gathered_, *pixels_);
  gpu::finish();
  picture_ = upsampling_.resolve(environment, pixels_->download<glm::vec4>(), log);
}

void EnvironmentLight::update(const Environment& environment, const InterpolateCpu& interpolate,
                              StageLog& log) {
  const StageTimer timer(log, "environment");
  log.count("environment_updates", 1);
  const std::vector<glm::dvec3> nodes = radiance_pyramid(mean_radiance(environment, square_));
  picture_ = upsampling_.resolve(environment, interpolate(multiply(rows_, nodes)), log);
}

std::optional<EnvironmentLight> make_environment_light(const PrepareContext& context, GatherSamples& gather,
                                                       bool gpu) {
  if (gather.environment.columns == 0) return std::nullopt;
  return std::make_optional<EnvironmentLight>(context, std::move(gather.environment), gpu);
}

}  // namespace relight::clustered_gather
