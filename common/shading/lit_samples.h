// Direct light on gather samples and on the view's sub-samples, on the GPU: what a method that gathers
// indirect light from lit points shades at each relight. A Shader for CachedDirectLight.
#pragma once

#include <vector>

#include "common/run/knobs.h"
#include "common/sampling/pixel_subset.h"
#include "common/shading/direct_lighting.h"

namespace relight {

// A vec4 each, rgb = radiance leaving a gather sample diffusely, or a sub-sample towards the eye.
struct LitSamplesGpuResult {
  gpu::Buffer gather, view;
  int64_t bytes() const { return gather.bytes() + view.bytes(); }
};

struct LitSamplesGpu {
  GpuSamples gather, view;
  DirectLighting lighting;

  // Everything must outlive this; of `buffer` the pixels that it asks for are lit. knobs: shadows (traced, or
  // else maps), shadow_map_size, area_light_samples.
  LitSamplesGpu(gpu::Context& gpu, const Scene& scene, const RayTracer& tracer, const DeepFrameBuffer& buffer,
                const KnobValues& knobs, std::vector<SurfaceSample> gather_samples)
      : LitSamplesGpu(gpu, scene, tracer, buffer, knobs,
                      GpuSamples(std::move(gather_samples), buffer.view.camera.eye)) {}
  LitSamplesGpu(gpu::Context& gpu, const Scene& scene, const RayTracer& tracer, const DeepFrameBuffer& buffer,
                const KnobValues& knobs, GpuSamples gather_samples)
      : gather(std::move(gather_samples)),
        view(wanted_direct_samples(buffer), buffer.view.camera.eye),
        lighting(gpu, scene, tracer,
                 {knobs.choice("shadows") == "traced" ? Shadows::traced : Shadows::map,
                  static_cast<int>(knobs.integer("shadow_map_size")),
                  static_cast<int>(knobs.integer("area_light_samples"))}) {
    if (knobs.choice("shadows") == "traced") return;
    gather.drop_host();
    view.drop_host();
  }

  LitSamplesGpuResult make() const {
    return {gpu::Buffer(static_cast<int64_t>(gather.size()) * 16),
            gpu::Buffer(static_cast<int64_t>(view.size()) * 16)};
  }
  void shade(const std::vector<Light>& lights, LitSamplesGpuResult& out, Onto onto, StageLog& log) {
    lighting.shade(lights, {{&gather, Lobes::diffuse, &out.gather}, {&view, Lobes::all, &out.view}}, onto,
                   log);
  }
  void copy(const LitSamplesGpuResult& from, LitSamplesGpuResult& to) const {
    to.gather.copy_from(from.gather);
    to.view.copy_from(from.view);
  }
};

}  // namespace relight
