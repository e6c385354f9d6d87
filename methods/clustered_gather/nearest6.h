// Nearest neighbours in the six-dimensional space of points6.h; the search tree is nanoflann's.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "methods/clustered_gather/points6.h"

namespace relight::clustered_gather {

struct Neighbour6 {
  float distance2;
  uint32_t index;
};

class Nearest6 {
 public:
  // `points` must outlive this; at least one.
  explicit Nearest6(std::span<const Point6> points);
  ~Nearest6();
  // The `count` nearest points (or all, if there are fewer), nearest first; ties go to the smaller index.
  void find(const Point6& from, size_t count, std::vector<Neighbour6>& out) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace relight::clustered_gather
