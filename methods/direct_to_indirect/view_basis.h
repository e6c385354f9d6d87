// The basis that the rows of the final-gather matrix belong to. The paper has one row a view sample. With
// view_basis=haar the rows of each tile of 4x4 view samples are transformed to Haar across the tile
// (common/wavelet/picture_haar.h) and share the tile's budget of coefficients: where the light that reaches
// neighbours is alike, one row holds it for all of them with many coefficients, and the others hold little.
// The transform is orthonormal, so what truncation drops from the rows is what the pixels lose. Not in the
// paper.
//
// A tile that holds background is not transformed. The glossy matrix keeps a row for each view sample, and so
// do those of the environment.
#pragma once

#include <optional>

#include "common/run/knobs.h"
#include "common/wavelet/picture_haar.h"
#include "methods/direct_to_indirect/indirect_grid.h"

namespace relight::direct_to_indirect {

// None for view_basis=pixels.
std::optional<wavelet::PictureHaar> view_basis(const IndirectGrid& grid, const KnobValues& knobs);

}  // namespace relight::direct_to_indirect
