// The Haar transform of sparse rows of a tile's 16 lanes at once: what the walk of tile_gather.h does for
// links, for rows whose elements come from elsewhere.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "methods/direct_to_indirect/lanes.h"

namespace relight::direct_to_indirect {

// One node of a level with `nodes` of them: the scaling coefficient from its four children's; appends the
// details if any is not zero.
Lanes analyse_lanes(const std::array<const Lanes*, 4>& child, uint32_t node, uint32_t nodes,
                    std::vector<LaneCoefficient>& out);

// values: elements by sample, ascending and below n (a power of four), each once; used up. Appends the
// coefficients that are not zero for all lanes, in no particular order. Cost: proportional to values.size() x
// log4(n).
void forward_lanes(std::vector<LaneCoefficient>& values, uint32_t n, std::vector<LaneCoefficient>& out);

}  // namespace relight::direct_to_indirect
