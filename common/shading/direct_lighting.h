// Deferred direct lighting of any set of surface samples (view or gather), on the GPU with shadow maps or
// with traced shadows (Hasan 2006 section 5, first paragraphs), and its plain CPU twin.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/gpu/buffer.h"
#include "common/gpu/context.h"
#include "common/gpu/texel_view.h"
#include "common/run/stage_log.h"
#include "common/sampling/surface_sample.h"
#include "common/scene/scene.h"
#include "common/shading/sample_formats.h"

namespace relight {

class RayTracer;

// Surface samples resident on the GPU. Invalid samples shade to black.
class GpuSamples {
 public:
  // slab_samples: the most that one dispatch shades, a multiple of 8192; 0: what the GPU takes.
  GpuSamples(std::vector<SurfaceSample> samples, const glm::vec3& eye, int64_t slab_samples = 0);
  // Likewise of samples in a compact format.
  GpuSamples(const CompactSamples& samples, const glm::vec3& eye, int64_t slab_samples = 0);
  size_t size() const { return size_; }
  SampleFormat format() const { return format_; }
  // Of a compact format, for shaders: sample_formats.glsl.
  const glm::vec4& frame() const { return frame_; }
  float unit() const { return unit_; }
  // Only traced shadows read the samples on the host. Nothing after drop_host(), which frees 128 bytes each.
  const std::vector<SurfaceSample>& host() const { return samples_; }
  void drop_host() { samples_ = {}; }
  const glm::vec3& eye() const { return eye_; }
  int64_t bytes() const;
  // A large view may exceed what one dispatch can write (128 MiB under llvmpipe) or one texel view shows, so
  // it is shaded slab by slab.
  struct Slab {
    int64_t first = 0, count = 0;  // samples
    gpu::TexelView data, shapes;   // four texels a sample (compact: five, one), two texels a sample
  };
  const std::vector<Slab>& slabs() const { return slabs_; }
  bool has_glossy() const { return has_glossy_; }
  // Where all glossy parts are Phong there are no shapes; the slabs then show something else in their place.
  bool has_shapes() const { return shapes_.bytes() > 0; }

 private:
  void cut(int64_t slab_samples);
  Slab slab(int64_t first, int64_t count) const;

  std::vector<SurfaceSample> samples_;
  size_t size_;
  glm::vec3 eye_;
  SampleFormat format_ = SampleFormat::full;
  glm::vec4 frame_{0.0f};
  float unit_ = 1.0f;
  gpu::Buffer data_;
  gpu::Buffer shapes_;  // BrdfShape of each sample; empty if all are zero
  std::vector<Slab> slabs_;
  bool has_glossy_ = false;
};

enum class Shadows { map, traced };

inline constexpr int default_area_light_samples = 16;

struct DirectLightingSettings {
  Shadows shadows = Shadows::map;
  // Texels a side: of a spot's or directional light's map, and of each of an omni's six faces. Away from
  // shadow edges the maps show no false shadows; surfaces closer to each other than about two texels may let
  // light through.
  int shadow_map_size = 2048;
  // Points that stand for a rectangle or disc, each with shadows of its own.
  int area_light_samples = default_area_light_samples;
};

// One shaded channel set: which lobes leave the sample.
enum class Lobes { diffuse, all };

// What the light of a call is added to.
enum class Onto { nothing, what_is_there };

class DirectLighting {
 public:
  DirectLighting(gpu::Context& gpu, const Scene& scene, const RayTracer& tracer,
                 DirectLightingSettings settings);
  ~DirectLighting();
  // Renders the shadow maps (or traces the shadow rays) for each light once and shades every set: out[i]
  // receives one vec4 a sample, rgb = radiance leaving sets[i] towards the eye (for Lobes::diffuse: in any
  // direction). Emission is not included. Lights of zero intensity cost nothing. Logs stages "shadow_maps"
  // (or "shadow_rays") and "direct_shading", counters shadow_maps_rendered (1 for a spot or directional
  // light, up to 6 for a cube, 5 for each point of an area), shadow_rays and shader_invocations; a radiance
  // that is not finite is counted, warned of and replaced by zero (debug: an Error).
  struct Request {
    const GpuSamples* samples;
    Lobes lobes;
    gpu::Buffer* out;  // size() x 16 bytes
  };
  void shade(const LightingState& lighting, const std::vector<Request>& requests, StageLog& log);
  // The same for some lights, added to what the outputs hold or to zero.
  void shade(std::span<const Light> lights, const std::vector<Request>& requests, Onto onto, StageLog& log);
  int64_t bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The CPU twin, with traced shadows: the exact alternative and the oracle. Parallel, deterministic.
std::vector<glm::vec3> shade_direct_cpu(const RayTracer& tracer, const std::vector<SurfaceSample>& samples,
                                        const glm::vec3& eye, const LightingState& lighting, Lobes lobes,
                                        int area_light_samples = default_area_light_samples);

}  // namespace relight
