// Direct light on gather samples and on the view's sub-samples, on the CPU with traced shadows; see
// lit_samples.h.
#pragma once

#include <string>
#include <vector>

#include "common/run/error.h"
#include "common/run/knobs.h"
#include "common/sampling/pixel_subset.h"
#include "common/shading/block_lighting.h"

namespace relight {

// Radiance of the gather samples, in whole blocks of 16, and of the view filtered to pixels, in the order of
// pixel_quad_order.
struct LitSamplesCpuResult {
  std::vector<glm::vec4> gather, view;
  int64_t bytes() const { return static_cast<int64_t>((gather.size() + view.size()) * sizeof(glm::vec4)); }
};

struct LitSamplesCpu {
  SampleBlocks gather, view;
  BlockLighting lighting;

  // Everything must outlive this; of `buffer` the pixels that it asks for are lit. knobs: area_light_samples;
  // Error, with the method's name, for shadows=map, which needs the GPU.
  LitSamplesCpu(const std::string& method, const RayTracer& tracer, const DeepFrameBuffer& buffer,
                const KnobValues& knobs, const std::vector<SurfaceSample>& gather_samples)
      : gather(gather_samples, sequential_order(gather_samples.size()), buffer.view.camera.eye),
        view(wanted_direct_samples(buffer), pixel_quad_order(buffer.view.width, buffer.view.height),
             buffer.view.camera.eye),
        lighting(tracer, static_cast<int>(knobs.integer("area_light_samples"))) {
    if (knobs.choice("shadows") == "map")
      fail("{}.shadows: 'map' needs the GPU; valid with device=cpu: auto, traced", method);
  }

  LitSamplesCpuResult make() const {
    return {std::vector<glm::vec4>(gather.count() * block_lanes),
            std::vector<glm::vec4>(view.count() * block_lanes / 4)};
  }
  void shade(const std::vector<Light>& lights, LitSamplesCpuResult& out, Onto onto, StageLog& log) {
    lighting.shade(lights, {{&gather, Lobes::diffuse, 1, out.gather}, {&view, Lobes::all, 4, out.view}}, onto,
                   log);
  }
  void copy(const LitSamplesCpuResult& from, LitSamplesCpuResult& to) const { to = from; }
};

}  // namespace relight
