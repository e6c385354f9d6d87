// Which sides of which surfaces can take part in light transport towards a view. Every surface reflects on
// both sides, but the inner side of a closed solid is never lit or seen, and gather samples there would be
// wasted.
#pragma once

#include <cstdint>
#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"

namespace relight {

struct LiveSides {
  std::vector<uint8_t> sides;       // one a triangle: bit 0 = side of the area normal, bit 1 = the other side
  double dropped_area_share = 0.0;  // area of dead sides / area of all sides
  int64_t components = 0;
};

// Decides by random walks from the view samples (cosine-distributed bounces), counted by connected component
// (triangles that share vertex positions) and side. A side is dead if its hits per area are below
// `density_threshold` times the mean over all hit sides: it then matters for less than about that share of
// the gathered light. Deterministic.
LiveSides find_live_sides(const RayTracer& tracer, const DeepFrameBuffer& buffer, uint64_t seed,
                          double density_threshold = 1e-3);

// Every side of every triangle.
LiveSides all_sides_live(const Scene& scene);

}  // namespace relight
