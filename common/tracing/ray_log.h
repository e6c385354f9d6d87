// The rays of a computation, kept so that they can be traced again by Embree alone: what a renderer reaches
// is reported as a share of that.
#pragma once

#include <cstdint>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include <glm/glm.hpp>

#include "common/tracing/points16.h"

namespace relight {

struct RayLog {
  enum class Kind : uint8_t { nearest, occlusion, packet };
  struct Ray {
    glm::vec3 origin, direction;
    float t_far;
  };
  struct Packet {
    Points16 origin;  // inactive entries: any finite point
    glm::vec3 end;    // of all segments; if `parallel`, each segment's end minus its origin
    uint32_t active;
    bool parallel = false;
  };
  // One thread's rays, in the order in which it traced them.
  struct Thread {
    std::vector<Kind> order;
    std::vector<Ray> rays;
    std::vector<Packet> packets;
  };
  tbb::enumerable_thread_specific<Thread> threads;

  void add(Kind kind, const glm::vec3& origin, const glm::vec3& direction, float t_far) {
    Thread& thread = threads.local();
    thread.order.push_back(kind);
    thread.rays.push_back({origin, direction, t_far});
  }
  void add(const Packet& packet) {
    Thread& thread = threads.local();
    thread.order.push_back(Kind::packet);
    thread.packets.push_back(packet);
  }
};

// Rays by kind; a packet counts as its active rays.
struct RayCounts {
  int64_t nearest = 0, occlusion = 0, in_packets = 0;
  int64_t total() const { return nearest + occlusion + in_packets; }
};

}  // namespace relight
