// Which samples lie away from the edges of a light's shadows, judged by traced rays only.
#pragma once

#include <cstdint>
#include <vector>

#include "common/lights/light.h"
#include "common/sampling/surface_sample.h"

namespace relight {
class RayTracer;
}

namespace relight::test {

// Edge length of a shadow-map texel at unit depth.
float texel_at_unit_depth(const Light& light, int map_size);

// 1 for each lit-side sample whose traced visibility equals that of 24 points around it: the sample moved by
// 0.5, 1 and 1.5 texels across the line to the light, in eight directions, and projected along the light onto
// its tangent plane. Samples that the light cannot light count as away.
std::vector<uint8_t> away_from_shadow_edges(const RayTracer& tracer,
                                            const std::vector<SurfaceSample>& samples, const Light& light,
                                            int map_size);

// The same for a directional light, whose map has texels of the given width everywhere.
std::vector<uint8_t> away_from_parallel_shadow_edges(const RayTracer& tracer,
                                                     const std::vector<SurfaceSample>& samples,
                                                     const Light& light, float texel);

}  // namespace relight::test
