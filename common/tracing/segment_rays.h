// The packet behind a SegmentFan. Only for files that talk to Embree.
#pragma once

#include <embree3/rtcore.h>

#include "common/tracing/segment_fan.h"

namespace relight {

struct SegmentFan::Rays {
  alignas(64) RTCRay16 packet;
  alignas(64) int valid[16];
};

}  // namespace relight
