// The deep frame buffer: what the camera sees, independent of light (papers/Hasan 2006 section 3.1, 3.6).
// One view sample a pixel (pixel centre) for indirect light, 2x2 a pixel for direct light, and an edge mask.
#pragma once

#include <cstdint>
#include <vector>

#include "common/sampling/surface_sample.h"
#include "common/scene/scene.h"

namespace relight {

class RayTracer;

struct View {
  Camera camera;
  int width = 640, height = 480;
};

struct DeepFrameBuffer {
  View view;
  std::vector<SurfaceSample> indirect;  // width x height, row-major, row 0 on top
  std::vector<SurfaceSample> direct;    // 2 width x 2 height, row-major; sub-pixel centres at 0.25 and 0.75
  std::vector<uint8_t> edge;            // width x height; 1 = geometric edge (see edge_mask.h)
  // width x height; 1 = a pixel whose result is asked for; empty: all are. What a method takes from the view
  // as a whole (importance, thresholds) stays that of the whole view; other pixels it may leave black.
  std::vector<uint8_t> wanted;
  // Of a compact buffer (pixel_subset.h) by pixel: its place in the picture that the camera sees, whose size
  // this is; negative beyond its rim. Empty: pixels are where they are.
  std::vector<glm::ivec2> place;
  glm::ivec2 place_size{0};
  // Unit direction in which the eye looks through a sub-pixel of the 2 width x 2 height grid; 0 beyond the
  // rim.
  glm::vec3 eye_direction(int sub_x, int sub_y) const;
  double edge_share() const;  // share of pixels with edge = 1, in [0,1]
};

// Casts the camera rays. Deterministic; parallel over rows.
DeepFrameBuffer make_deep_frame_buffer(const Scene& scene, const RayTracer& tracer, const View& view);

// Marks pixels whose 3x3 neighbourhood or own 2x2 sub-samples hold a depth or normal discontinuity, or both
// hits and misses. Depth: distance of a neighbour from the sample's tangent plane > `depth_tolerance` x its
// eye distance; normal: cosine of geometric normals < `normal_cosine`.
std::vector<uint8_t> edge_mask(const DeepFrameBuffer& buffer, float depth_tolerance = 0.02f,
                               float normal_cosine = 0.9f);

}  // namespace relight
