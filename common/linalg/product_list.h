// The forms of the transfer product by name.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/linalg/sparse_rows.h"
#include "common/linalg/transfer_product.h"

namespace relight {

// rows: row by row (Hasan 2006 section 5, the comparison). tiles: blocks of a screen tile, summed in
// registers. quads: blended rectangles of the columns (the paper's own). quads is for the GPU only.
const std::vector<std::string>& product_forms();

// scale: one RGB factor a row. Throws Error on an unknown form, naming the known ones, on quads for the CPU,
// and as the forms themselves.
std::unique_ptr<TransferProduct> make_product_cpu(const std::string& form, const SparseRows& matrix,
                                                  std::span<const glm::vec3> scale, PictureShape shape,
                                                  const ProductSettings& settings);
// Uses the current context. max_block_bytes: its limit of a storage block.
std::unique_ptr<TransferProductGpu> make_product_gpu(const std::string& form, const SparseRows& matrix,
                                                     std::span<const glm::vec3> scale, PictureShape shape,
                                                     const ProductSettings& settings,
                                                     int64_t max_block_bytes);

}  // namespace relight
