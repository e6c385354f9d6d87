// What both devices read from the knobs and the view to make the transfer product of equation 7.
#pragma once

#include <string>
#include <vector>

#include "common/linalg/transfer_product.h"
#include "common/run/knobs.h"
#include "common/run/stage_log.h"
#include "methods/direct_to_indirect/final_gather.h"
#include "methods/direct_to_indirect/indirect_grid.h"

namespace relight::direct_to_indirect {

// k_d of equation 7: one a sample of the grid.
std::vector<glm::vec3> diffuse_albedo(const IndirectGrid& grid);

// What the product multiplies rows with: k_d, or 1 where a basis (view_basis.h) applies k_d to pixels later.
std::vector<glm::vec3> row_factors(const IndirectGrid& grid, bool basis);

// The picture that the matrix's rows are.
PictureShape picture_shape(const IndirectGrid& grid);

// Knobs weights, partial_results, cull_epsilon and block_waste.
ProductSettings product_settings(const KnobValues& knobs, const IndirectGrid& grid);

// Bytes <name>_product, counters <name>_weights_stored, <name>_blocks and <name>_atlases.
void log_product(const std::string& name, const ProductStatistics& statistics, StageLog& log);

// Bytes final_gather_matrix, and glossy_matrix where there is one.
void log_matrices(const FinalGather& matrix, StageLog& log);

}  // namespace relight::direct_to_indirect
