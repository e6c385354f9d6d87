// Which gather sample stands for a point of the scene's surfaces: the closest in position and normal. The
// cells of this partition are what the samples' areas measure.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "common/sampling/gather_cloud.h"

namespace relight::direct_to_indirect {

class GatherCells {
 public:
  // `cloud` must outlive this.
  explicit GatherCells(const GatherCloud& cloud);
  ~GatherCells();
  // Nothing if no sample is within four cell widths, or the closest faces elsewhere: surfaces that the cloud
  // leaves out. Thread-safe, deterministic.
  std::optional<uint32_t> find(const glm::vec3& position, const glm::vec3& normal) const;

 private:
  struct Tree;
  const GatherCloud& cloud_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace relight::direct_to_indirect
