// The nearest photons of a point, by nanoflann's kd-tree.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "methods/direct_to_indirect/multi_bounce_photons.h"

namespace relight::direct_to_indirect {

struct Neighbour {
  float distance2;
  uint32_t photon;
};

class NearestPhotons {
 public:
  // `photons` must outlive this.
  explicit NearestPhotons(const std::vector<Photon>& photons);
  ~NearestPhotons();
  // Fills `out` with the `count` nearest photons (all if there are fewer), in no particular order; count
  // >= 1.
  void find(const glm::vec3& position, size_t count, std::vector<Neighbour>& out) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace relight::direct_to_indirect
