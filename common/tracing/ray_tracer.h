// Embree behind one small interface. Checks every ray for NaN first: Embree aborts the process on one.
#pragma once

#include <cstdint>
#include <memory>

#include "common/sampling/surface_sample.h"
#include "common/scene/scene.h"
#include "common/tracing/ray_log.h"
#include "common/tracing/segment_fan.h"

namespace relight {

struct Hit {
  uint32_t triangle = 0;
  float t = 0.0f;
  float u = 0.0f, v = 0.0f;  // barycentrics of vertices 1 and 2
  bool valid = false;
};

class RayTracer {
 public:
  // Builds the BVH. The scene must outlive the tracer. Throws Error if Embree fails.
  explicit RayTracer(const Scene& scene);
  ~RayTracer();
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  const Scene& scene() const { return scene_; }

  // Nearest hit of the ray; direction need not be unit, t is in units of its length.
  Hit intersect(const glm::vec3& origin, const glm::vec3& direction, float t_far = 1e30f) const;

  // Turns a hit into a surface sample seen along `direction` (normals face the ray's origin).
  SurfaceSample surface(const Hit& hit, const glm::vec3& direction) const;
  // Starts to fetch what surface(hit) will read. Called for several hits before surface() of the first, it
  // lets their cache misses overlap.
  void prefetch_surface(const Hit& hit) const;

  // True if the open segment between two surface points is free. Each end is first moved off its surface
  // along its geometric normal (on the side where the other end is) by offset().
  bool visible(const glm::vec3& p, const glm::vec3& np, const glm::vec3& q, const glm::vec3& nq) const;
  // The same from a surface point to a point in space (a light), which is not moved.
  bool visible_from_point(const glm::vec3& p, const glm::vec3& np, const glm::vec3& light) const;

  // 16 segments at once from p[i] to one common end; coherent packets. active: bit i set = test segment i.
  // Returns the mask of segments that are free. Positions must already be offset (see offset_point).
  uint32_t visible16(const glm::vec3* p, const glm::vec3& q, uint32_t active) const;
  // The same for many ends q, one after another: the fan keeps the points, and writes into its packet, so that
  // a fan is for one thread.
  uint32_t visible16(const SegmentFan& fan, const glm::vec3& q, uint32_t active) const;
  // The same for 16 parallel segments, from p[i] to p[i] + v.
  uint32_t visible16_along(const glm::vec3* p, const glm::vec3& v, uint32_t active) const;

  // Point p moved off its surface to the side of n: by a distance that scales with the largest coordinate of
  // the scene (float rounding of intersection points does too), so that scaling and moving scenes changes
  // nothing else.
  glm::vec3 offset_point(const glm::vec3& p, const glm::vec3& n) const { return p + n * offset_; }
  float offset() const { return offset_; }

  // Keeps every ray traced from now on; null: none. Not to be changed while rays are traced.
  void set_log(RayLog* log) { log_ = log; }
  // Traces the rays of one thread's log again, by Embree alone: no checks, no offsets, no shading.
  RayCounts replay(const RayLog::Thread& log) const;

 private:
  // Segments to `end`, or parallel: along it.
  uint32_t free16(const glm::vec3* p, const glm::vec3& end, bool parallel, uint32_t active) const;

  const Scene& scene_;
  RayLog* log_ = nullptr;
  float offset_ = 0.0f;
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace relight
