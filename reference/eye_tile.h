// The visible points of a 4x4 tile of pixels, which are connected to light vertices and start their paths
// together: what all 16 need is kept by coordinate, for loops that the compiler vectorises.
#pragma once

#include <cstdint>

#include "common/tracing/points16.h"
#include "common/tracing/segment_fan.h"
#include "reference/path_vertex.h"

namespace relight {

struct EyeTile {
  EyeVertex vertex[16];
  Points16 position, shading_normal, geometric_normal;
  SegmentFan start;           // positions moved off the surface
  Points16 diffuse;           // BRDF of the diffuse lobe [1/sr]
  float paths = 1.0f;         // EyeVertex::paths of all of them
  uint32_t valid = 0;         // bit i: vertex[i] is there
  uint32_t only_diffuse = 0;  // bit i: and it has no glossy lobe

  // `moved`: the vertex moved off its surface.
  void set(unsigned i, const EyeVertex& x, const glm::vec3& moved) {
    vertex[i] = x;
    vertex[i].paths = paths;
    position.set(i, x.surface->position);
    shading_normal.set(i, x.surface->shading_normal);
    geometric_normal.set(i, x.surface->geometric_normal);
    start.set(i, moved);
    diffuse.set(i, shader::brdf_diffuse(x.brdf));
    valid |= 1u << i;
    if (black(x.brdf.glossy)) only_diffuse |= 1u << i;
  }
};

}  // namespace relight
