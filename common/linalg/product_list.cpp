#include "common/linalg/product_list.h"

#include "common/linalg/patch_product_cpu.h"
#include "common/linalg/quad_product_gpu.h"
#include "common/linalg/sparse_product_cpu.h"
#include "common/linalg/sparse_product_gpu.h"
#include "common/linalg/tile_product_gpu.h"
#include "common/run/error.h"

namespace relight {

const std::vector<std::string>& product_forms() {
  static const std::vector<std::string> forms = {"rows", "tiles", "quads"};
  return forms;
}

std::unique_ptr<TransferProduct> make_product_cpu(const std::string& form, const SparseRows& matrix,
                                                  std::span<const glm::vec3> scale, PictureShape shape,
                                                  const ProductSettings& settings) {
  if (form == "rows") return std::make_unique<SparseProductCpu>(matrix, scale, settings.weights);
  if (form == "tiles") return std::make_unique<PatchProductCpu>(matrix, scale, shape, settings.weights);
  if (form == "quads") fail("product quads blends on the GPU; on the CPU there are rows and tiles");
  fail("product '{}': expected {}", form, fmt::join(product_forms(), ", "));
}

std::unique_ptr<TransferProductGpu> make_product_gpu(const std::string& form, const SparseRows& matrix,
                                                     std::span<const glm::vec3> scale, PictureShape shape,
                                                     const ProductSettings& settings,
                                                     int64_t max_block_bytes) {
  if (form == "rows")
    return std::make_unique<SparseProductGpu>(matrix, scale, max_block_bytes, settings.weights);
  if (form == "tiles")
    return std::make_unique<TileProductGpu>(matrix, scale, shape, settings, max_block_bytes);
  if (form == "quads") return std::make_unique<QuadProductGpu>(matrix, scale, shape, settings);
  fail("product '{}': expected {}", form, fmt::join(product_forms(), ", "));
}

}  // namespace relight
