#include "methods/direct_to_indirect/transfer_settings.h"

#include <algorithm>

namespace relight::direct_to_indirect {

std::vector<glm::vec3> diffuse_albedo(const IndirectGrid& grid) {
  const std::vector<SurfaceSample>& samples = grid.samples().indirect;
  std::vector<glm::vec3> kd(samples.size());
  std::transform(samples.begin(), samples.end(), kd.begin(),
                 [](const SurfaceSample& s) { return s.diffuse; });
  return kd;
}

std::vector<glm::vec3> row_factors(const IndirectGrid& grid, bool basis) {
  if (!basis) return diffuse_albedo(grid);
  return std::vector<glm::vec3>(grid.samples().indirect.size(), glm::vec3(1.0f));
}

PictureShape picture_shape(const IndirectGrid& grid) {
  return {grid.samples().view.width, grid.samples().view.height};
}

ProductSettings product_settings(const KnobValues& knobs, const IndirectGrid& grid) {
  ProductSettings settings;
  settings.rows_share = grid.tile_share();
  settings.weights = weight_format_from_string(knobs.choice("weights"));
  settings.partial_results =
      knobs.choice("partial_results") == "float16" ? PartialResults::float16 : PartialResults::float32;
  settings.cull_epsilon = static_cast<float>(knobs.real("cull_epsilon"));
  settings.block_waste = static_cast<float>(knobs.real("block_waste"));
  return settings;
}

void log_product(const std::string& name, const ProductStatistics& statistics, StageLog& log) {
  log.bytes(name + "_product", statistics.bytes);
  log.count(name + "_weights_stored", statistics.stored);
  log.count(name + "_blocks", statistics.blocks);
  log.count(name + "_atlases", statistics.atlases);
}

void log_matrices(const FinalGather& matrix, StageLog& log) {
  log.bytes("final_gather_matrix", matrix.diffuse.bytes());
  if (!matrix.glossy_pixels.empty())
    log.bytes("glossy_matrix",
              matrix.glossy.bytes() + static_cast<int64_t>(matrix.glossy_pixels.size() * sizeof(uint32_t)));
}

}  // namespace relight::direct_to_indirect
