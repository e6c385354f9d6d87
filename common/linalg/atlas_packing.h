// Rectangles packed into square texture atlases (Hasan 2006 section 4.4): sorted by height, each goes to the
// first free rectangle of a list that it fits; what is left of that rectangle, to the right and below, takes
// its place in the list.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace relight {

struct AtlasSize {
  int width, height;
};

struct AtlasPlace {
  int32_t atlas;
  uint16_t x, y;  // of the upper left texel
};

struct AtlasPacking {
  std::vector<AtlasPlace> places;  // one a rectangle, in the order given
  std::vector<int> heights;        // of each atlas: up to its last texel in use
  // Share of the atlases' texels (width atlas_size, those heights) that is taken; 0 without atlases.
  double fill = 0.0;
};

// Deterministic. Throws Error naming the first rectangle with a side below 1 or above atlas_size.
AtlasPacking pack_into_atlases(std::span<const AtlasSize> sizes, int atlas_size);

}  // namespace relight
