// How much each part of the scene's surfaces matters for the indirect light of a view (Hasan 2006
// section 4.1; the idea of importance is from Smits, Arvo, Salesin 1992): the density of particles shot from
// the view samples, by side of surface.
//
// Surfaces reflect on both sides here, so the map also tells which sides light can use at all: the inside of
// a closed solid, or the outer walls of a building seen from within, get no particles and need no gather
// samples.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "common/sampling/deep_frame_buffer.h"
#include "common/tracing/ray_tracer.h"

namespace relight {

// What gathers from the gather cloud.
struct CloudView {
  const DeepFrameBuffer& buffer;
  int bounces = 1;      // of the light paths behind the view samples
  bool glossy = false;  // do view samples gather by their glossy lobes, too?
};

// Particles are counted in bins: connected component and side of the surface x cell of a cubic grid x one of
// six normal directions (axis and sign); cell and normal keep the inner walls of a building apart from its
// outer ones. Whether a place was reached at all is kept for 32 layers of each cell along that axis, so that
// buried faces (the covered top of a lower step) are told from visible ones nearby. Not told apart: faces of
// one component and orientation closer than a layer.
class ImportanceMap {
 public:
  // Shoots `particles` rays from random view samples, cosine-distributed, each followed for view.bounces hits
  // with its weight multiplied by the luminance of the diffuse albedos passed; with view.glossy, those from
  // glossy view samples follow the whole BRDF towards the eye. cell: edge of the grid's cells [scene units].
  // Deterministic for any number of threads.
  ImportanceMap(const RayTracer& tracer, const CloudView& view, int64_t particles, float cell, uint64_t seed);

  // Number of the bin of a point on one side of a triangle (flipped: the side away from its area normal).
  uint64_t bin(const glm::vec3& position, uint32_t triangle, bool flipped) const;
  // Total weight of the particles in a bin.
  double weight(uint64_t bin) const;
  // Did any particle land in the layer of this point's bin?
  bool reached(const glm::vec3& position, uint32_t triangle, bool flipped) const;
  double total_weight() const { return total_; }

 private:
  uint64_t layer(uint64_t bin, const glm::vec3& position, uint32_t triangle) const;

  const Scene& scene_;
  float cell_;
  std::vector<uint32_t> component_;  // by triangle
  std::unordered_map<uint64_t, double> weights_;
  std::unordered_set<uint64_t> reached_;  // layers
  double total_ = 0.0;
};

}  // namespace relight
