#include "common/tracing/ray_tracer.h"
#include "common/finite.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/run/error.h"
#include "common/tracing/segment_rays.h"

namespace relight {

namespace {

// Interpolating a hit point in float costs about 3 ulps of the largest coordinate (three products, two sums),
// and Embree's robust distance test some 10 ulps of the distance to the triangle's vertices, which is no
// larger. 32 ulps cover both with a factor of two; 32 x 2^-23 = 4e-6 of the largest coordinate stays far
// below any feature. Camera and lights don't enter: hit points come from barycentrics, not from eye + t *
// direction.
constexpr float offset_in_ulps = 32.0f;

[[noreturn]] void refuse_ray(const char* what, const glm::vec3& a, const glm::vec3& b) {
  fail(
      "tracing: ray with a non-finite {}: ({}, {}, {}) and ({}, {}, {}); positions, normals and directions "
      "must be finite",
      what, a.x, a.y, a.z, b.x, b.y, b.z);
}

void set_ray(RTCRay& ray, const glm::vec3& origin, const glm::vec3& direction, float t_far) {
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = 0.0f, ray.tfar = t_far;
  ray.time = 0.0f, ray.mask = 0xffffffffu, ray.id = 0, ray.flags = 0;
}

float largest_coordinate(const Bounds& bounds) {
  if (bounds.lo.x > bounds.hi.x) return 0.0f;
  const glm::vec3 m = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
  return std::max({m.x, m.y, m.z});
}

Bounds bounds_of_triangles(const Scene& scene) {
  Bounds bounds;
  for (const Triangle& triangle : scene.triangles)
    for (uint32_t v : triangle.v) bounds.add(scene.positions[v]);
  return bounds;
}

// +1 if `to` lies on the side of n, else -1.
float side(const glm::vec3& n, const glm::vec3& from, const glm::vec3& to) {
  return glm::dot(n, to - from) < 0.0f ? -1.0f : 1.0f;
}

// A segment from origin to origin + direction, at place i of a packet.
void set_segment(RTCRay16& rays, unsigned i, const glm::vec3& origin, const glm::vec3& direction) {
  rays.org_x[i] = origin.x, rays.org_y[i] = origin.y, rays.org_z[i] = origin.z;
  rays.dir_x[i] = direction.x, rays.dir_y[i] = direction.y, rays.dir_z[i] = direction.z;
  rays.tnear[i] = 0.0f, rays.tfar[i] = 1.0f;
  rays.time[i] = 0.0f, rays.mask[i] = 0xffffffffu, rays.id[i] = 0, rays.flags[i] = 0;
}

}  // namespace

struct RayTracer::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Embree() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  void check(const char* step) const {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
      fail("tracing: Embree failed while {} (error {}{})", step, static_cast<int>(error),
           error == RTC_ERROR_OUT_OF_MEMORY ? ": out of memory" : "");
  }
  void build(const Scene& source);
  bool free_segment(const glm::vec3& a, const glm::vec3& b) const;
  bool occluded(const glm::vec3& origin, const glm::vec3& direction) const;
  uint32_t occluded16(const RayLog::Packet& packet) const;
  uint32_t trace16(const int* valid, RTCRay16& rays, uint32_t active) const;
};

void RayTracer::Embree::build(const Scene& source) {
  device = rtcNewDevice(nullptr);
  if (!device)
    fail("tracing: Embree gives no device (error {})", static_cast<int>(rtcGetDeviceError(nullptr)));
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree loads vertices 16 bytes at a time and so reads past the end of a vector of vec3; its own buffer is
  // padded.
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), source.positions.size()));
  check("allocating vertices");
  for (const glm::vec3& p : source.positions) *vertices++ = p.x, *vertices++ = p.y, *vertices++ = p.z;
  // The index buffer is shared: 12 of each 20 bytes are read.
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, source.triangles.data(),
                             offsetof(Triangle, v), sizeof(Triangle), source.triangles.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  check("building the hierarchy");
}

bool RayTracer::Embree::free_segment(const glm::vec3& a, const glm::vec3& b) const {
  const glm::vec3 direction = b - a;
  if (!finite(a) || !finite(direction)) refuse_ray("end", a, b);
  return !occluded(a, direction);
}

bool RayTracer::Embree::occluded(const glm::vec3& origin, const glm::vec3& direction) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  alignas(16) RTCRay ray;
  set_ray(ray, origin, direction, 1.0f);
  rtcOccluded1(scene, &context, &ray);
  return ray.tfar < 0.0f;  // Embree marks an occluded ray with tfar = -infinity
}

// Bits of the active segments that something blocks.
uint32_t RayTracer::Embree::trace16(const int* valid, RTCRay16& rays, uint32_t active) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
  uint32_t blocked = 0;
  for (unsigned i = 0; i < 16; ++i) blocked |= (rays.tfar[i] < 0.0f ? 1u : 0u) << i;
  return blocked & active;
}

uint32_t RayTracer::Embree::occluded16(const RayLog::Packet& packet) const {
  alignas(64) RTCRay16 rays;
  alignas(64) int valid[16];
  const glm::vec3 end = packet.end;
  for (unsigned i = 0; i < 16; ++i) {
    valid[i] = (packet.active >> i) & 1u ? -1 : 0;
    const glm::vec3 origin = packet.origin.get(i);
    set_segment(rays, i, origin, packet.parallel ? end : end - origin);
  }
  return trace16(valid, rays, packet.active);
}

RayTracer::RayTracer(const Scene& scene) : scene_(scene), embree_(std::make_unique<Embree>()) {
  const float magnitude = largest_coordinate(bounds_of_triangles(scene));
  if (!std::isfinite(magnitude)) fail("tracing: scene '{}' has a non-finite vertex", scene.name);
  offset_ = offset_in_ulps * std::numeric_limits<float>::epsilon() * magnitude;
  embree_->build(scene);
}

RayTracer::~RayTracer() = default;

Hit RayTracer::intersect(const glm::vec3& origin, const glm::vec3& direction, float t_far) const {
  if (!finite(origin) || !finite(direction)) refuse_ray("origin or direction", origin, direction);
  if (!(t_far >= 0.0f)) fail("tracing: ray with t_far = {}; it must be >= 0", t_far);
  if (log_) log_->add(RayLog::Kind::nearest, origin, direction, t_far);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  alignas(16) RTCRayHit query;
  set_ray(query.ray, origin, direction, t_far);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->scene, &context, &query);
  Hit hit;
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit = {query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v, true};
  if (!(hit.t >= 0.0f && hit.t <= t_far) || hit.triangle >= scene_.triangles.size())
    throw std::logic_error(fmt::format("tracing: Embree reports triangle {} at t = {} outside [0, {}]",
                                       hit.triangle, hit.t, t_far));
  // Each hit becomes a surface: its cache miss begins now.
  __builtin_prefetch(&scene_.triangles[hit.triangle]);
  return hit;
}

bool RayTracer::visible(const glm::vec3& p, const glm::vec3& np, const glm::vec3& q,
                        const glm::vec3& nq) const {
  const glm::vec3 a = offset_point(p, np * side(np, p, q)), b = offset_point(q, nq * side(nq, q, p));
  if (log_) log_->add(RayLog::Kind::occlusion, a, b - a, 1.0f);
  return embree_->free_segment(a, b);
}

bool RayTracer::visible_from_point(const glm::vec3& p, const glm::vec3& np, const glm::vec3& light) const {
  const glm::vec3 a = offset_point(p, np * side(np, p, light));
  if (log_) log_->add(RayLog::Kind::occlusion, a, light - a, 1.0f);
  return embree_->free_segment(a, light);
}

uint32_t RayTracer::visible16(const SegmentFan& fan, const glm::vec3& q, uint32_t active) const {
  RTCRay16& rays = fan.rays_->packet;
  int* valid = fan.rays_->valid;
  uint32_t not_finite = 0;
  for (unsigned i = 0; i < 16; ++i) {
    const float x = q.x - rays.org_x[i], y = q.y - rays.org_y[i], z = q.z - rays.org_z[i];
    rays.dir_x[i] = x, rays.dir_y[i] = y, rays.dir_z[i] = z;
    rays.tfar[i] = 1.0f;
    valid[i] = -static_cast<int>((active >> i) & 1u);
    // The points are finite: 0 x a difference is 0 only if q and the difference are.
    not_finite |= x * 0.0f + y * 0.0f + z * 0.0f == 0.0f ? 0u : 1u;
  }
  if (not_finite) refuse_ray("end", {rays.org_x[0], rays.org_y[0], rays.org_z[0]}, q);
  if (log_) {
    RayLog::Packet packet;
    packet.end = q, packet.active = active;
    for (unsigned i = 0; i < 16; ++i) packet.origin.set(i, {rays.org_x[i], rays.org_y[i], rays.org_z[i]});
    log_->add(packet);
  }
  return active & ~embree_->trace16(valid, rays, active);
}

uint32_t RayTracer::visible16(const glm::vec3* p, const glm::vec3& q, uint32_t active) const {
  return free16(p, q, false, active);
}

uint32_t RayTracer::visible16_along(const glm::vec3* p, const glm::vec3& v, uint32_t active) const {
  return free16(p, v, true, active);
}

uint32_t RayTracer::free16(const glm::vec3* p, const glm::vec3& end, bool parallel, uint32_t active) const {
  RayLog::Packet packet;
  packet.end = end, packet.active = active, packet.parallel = parallel;
  for (unsigned i = 0; i < 16; ++i) {
    if (!((active >> i) & 1u)) continue;
    if (!finite(p[i]) || !finite(parallel ? end : end - p[i]))
      refuse_ray(parallel ? "origin or direction" : "end", p[i], end);
    packet.origin.set(i, p[i]);
  }
  if (log_) log_->add(packet);
  return active & ~embree_->occluded16(packet);
}

RayCounts RayTracer::replay(const RayLog::Thread& log) const {
  RayCounts counts;
  auto ray = log.rays.begin();
  auto packet = log.packets.begin();
  RTCIntersectContext context;
  for (const RayLog::Kind kind : log.order) {
    rtcInitIntersectContext(&context);
    if (kind == RayLog::Kind::packet) {
      embree_->occluded16(*packet);
      counts.in_packets += __builtin_popcount(packet->active);
      ++packet;
    } else if (kind == RayLog::Kind::occlusion) {
      embree_->occluded(ray->origin, ray->direction);
      ++counts.occlusion, ++ray;
    } else {
      alignas(16) RTCRayHit query;
      set_ray(query.ray, ray->origin, ray->direction, ray->t_far);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(embree_->scene, &context, &query);
      ++counts.nearest, ++ray;
    }
  }
  return counts;
}

}  // namespace relight
