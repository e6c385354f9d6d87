// Photons shot from the gather samples (Hasan 2006 section 4.3, "The multiple-bounce matrix"): each sample is
// a Lambertian emitter of the area that it represents, each photon is deposited and reflected at every
// surface that it hits and remembers the sample it came from.
//
// A sample j with area A_j and radiance 1 emits the flux pi A_j, in n photons of pi A_j / n each, cosine
// distributed about its geometric normal (which converts area to solid angle, as in the final gather). At a
// hit with shading normal ns and geometric normal ng, light from direction w irradiates by cos(ns, w) what
// flux measures by cos(ng, w): the deposited flux is multiplied by the ratio. It is then reflected by the
// albedo, cosine distributed about ng. Surfaces reflect on both sides; light from below the shading plane
// ends there.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "methods/direct_to_indirect/multi_bounce.h"

namespace relight::direct_to_indirect {

// One hit.
struct Photon {
  glm::vec3 position;
  uint32_t source;   // the gather sample that it came from
  glm::vec3 normal;  // geometric, on the side that it hit
  glm::vec3 area;  // its flux / pi for a unit of radiance leaving `source`: A_j / n x throughput, by channel
};

struct PhotonMap {
  std::vector<Photon> photons;  // by source, path, hit
  int64_t shot = 0, rays = 0;
  std::vector<double> power;  // [k]: luminance of the flux / pi reflected at the k-th hits; [0]: emitted
};

// Paths of settings.bounces - 1 hits, the paper's "path length" (3 for four bounces in all). Directions are
// Owen-scrambled Sobol points over the photons of a sample. Random numbers depend on seed, sample and hit
// only.
PhotonMap trace_photons(const MultiBounceInput& input, const MultiBounceSettings& settings);

}  // namespace relight::direct_to_indirect
