// The cameras of a light's shadow maps: one for a spot, the six faces of a cube for an omni or a wide spot, a
// parallel projection of the whole scene for a directional light.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "common/lights/emitter.h"
#include "common/scene/scene.h"

namespace relight {

// One square shadow map. Perspective: map coordinates of a point q seen from the light: with rel = q -
// position, x = dot(right, rel) / (tan_half * d), y likewise with up, d = dot(forward, rel); both in [-1,1]
// inside the map. Parallel: x = dot(right, rel) / tan_half, y likewise, whatever d.
struct ShadowFace {
  glm::vec3 right, up, forward;  // orthonormal; handedness does not matter, nothing is culled by facing
};

struct LightFrame {
  glm::vec3 position;     // of the light; parallel: the centre of the scene
  glm::mat3 axes;         // columns x, y, z of the light's own frame; z is a spot's direction
  float tan_half = 1.0f;  // tangent of half the opening of a map; parallel: half its width [scene units]
  float near = 1.0f;      // depth nearer than which nothing is drawn; parallel: half the range of depths
  int faces = 0;          // 1: map around z; 5 or 6: cube
  bool parallel = false;
  // Faces in the order +z, +x, -x, +y, -y, -z (as shadow_map.glsl reads them).
  ShadowFace face(int i) const;
};

// A single map's texels stretch with 1/cos^2 towards its rim; beyond 60 degrees four fifths of them would be
// spent outside a cube face's share.
constexpr float widest_single_map_degrees = 60.0f;

// reach: distance from the light to the farthest point of the scene [scene units, >= 0]. map_size: texels a
// side. The near plane lies at 2^-20 of the reach, below the rounding of the positions themselves, so it cuts
// nothing that matters even for a light on a surface; with reversed depth a near plane so close costs no
// precision.
LightFrame light_frame(const Emitter& light, float reach, int map_size);

// For a directional light. One map holds all of `bounds`, so that whatever casts a shadow is in it, however
// far from what is lit. Depth d = dot(axis, rel) lies within +-near.
LightFrame parallel_frame(const Emitter& light, const Bounds& bounds, int map_size);

}  // namespace relight
