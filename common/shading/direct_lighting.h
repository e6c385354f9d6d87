// Deferred direct lighting of any set of surface samples (view or gather), on the GPU with shadow maps or with
// traced shadows (Hasan 2006 section 5, first paragraphs), and its plain CPU twin.
#pragma once

#include <memory>
#include <vector>

#include "common/gpu/buffer.h"
#include "common/gpu/context.h"
#include "common/run/stage_log.h"
#include "common/sampling/surface_sample.h"
#include "common/scene/scene.h"

namespace relight {

class RayTracer;

// Surface samples resident on the GPU. Invalid samples shade to black.
class GpuSamples {
 public:
  GpuSamples(const std::vector<SurfaceSample>& samples, const glm::vec3& eye);
  size_t size() const { return samples_.size(); }
  const std::vector<SurfaceSample>& host() const { return samples_; }
  int64_t bytes() const;
  void bind(int first_binding) const;

 private:
  std::vector<SurfaceSample> samples_;
  gpu::Buffer data_;
};

enum class Shadows { map, traced };

struct DirectLightingSettings {
  Shadows shadows = Shadows::map;
  int shadow_map_size = 2048;  // texels a side: of a spot's map, and of each of an omni's six faces
};

// One shaded channel set: which lobes leave the sample.
enum class Lobes { diffuse, all };

class DirectLighting {
 public:
  DirectLighting(gpu::Context& gpu, const Scene& scene, const RayTracer& tracer, DirectLightingSettings settings);
  ~DirectLighting();
  // Renders the shadow maps (or traces the shadow rays) for each light once and shades every set: out[i] receives
  // one vec4 a sample, rgb = radiance leaving sets[i] towards the eye (for Lobes::diffuse: in any direction).
  // Logs stages "shadow_maps" (or "shadow_rays") and "direct_shading".
  struct Request {
    const GpuSamples* samples;
    Lobes lobes;
    gpu::Buffer* out;  // size() x 16 bytes
  };
  void shade(const LightingState& lighting, const std::vector<Request>& requests, StageLog& log);
  int64_t bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The CPU twin, with traced shadows: the exact alternative and the oracle. Parallel, deterministic.
std::vector<glm::vec3> shade_direct_cpu(const RayTracer& tracer, const std::vector<SurfaceSample>& samples,
                                        const glm::vec3& eye, const LightingState& lighting, Lobes lobes);

}  // namespace relight
