#include "common/tracing/segment_fan.h"

#include "common/finite.h"
#include "common/run/error.h"
#include "common/tracing/segment_rays.h"

namespace relight {

SegmentFan::SegmentFan() : rays_(std::make_unique<Rays>()) {
  RTCRay16& r = rays_->packet;
  r = {};
  for (unsigned& mask : r.mask) mask = 0xffffffffu;
}

SegmentFan::~SegmentFan() = default;
SegmentFan::SegmentFan(SegmentFan&&) noexcept = default;
SegmentFan& SegmentFan::operator=(SegmentFan&&) noexcept = default;

void SegmentFan::set(unsigned i, const glm::vec3& point) {
  if (!finite(point))
    fail("tracing: segment from a non-finite point ({}, {}, {}); positions must be finite", point.x, point.y,
         point.z);
  RTCRay16& r = rays_->packet;
  r.org_x[i] = point.x, r.org_y[i] = point.y, r.org_z[i] = point.z;
}

}  // namespace relight
