// Up to 16 fixed points from which segments to one end after another are tested (RayTracer::visible16). What
// does not change from end to end, most of a packet, is written once.
#pragma once

#include <memory>

#include <glm/glm.hpp>

namespace relight {

class SegmentFan {
 public:
  // All points at the origin.
  SegmentFan();
  ~SegmentFan();
  SegmentFan(SegmentFan&&) noexcept;
  SegmentFan& operator=(SegmentFan&&) noexcept;

  // Point i, offset from its surface (RayTracer::offset_point). Throws Error if it is not finite.
  void set(unsigned i, const glm::vec3& point);

 private:
  friend class RayTracer;
  struct Rays;
  std::unique_ptr<Rays> rays_;
};

}  // namespace relight
