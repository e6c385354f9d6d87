// Direct lighting of sets of samples on the CPU: shadow rays in packets of 16 towards the light, vectorised
// shading. The fast alternative to DirectLighting on a machine without a GPU; shade_direct_cpu is its oracle.
#pragma once

#include <span>
#include <vector>

#include "common/run/stage_log.h"
#include "common/shading/block_shading.h"
#include "common/shading/sample_blocks.h"

namespace relight {

class RayTracer;

class BlockLighting {
 public:
  // area_light_samples: points that stand for a rectangle or disc.
  explicit BlockLighting(const RayTracer& tracer, int area_light_samples = default_area_light_samples)
      : tracer_(tracer), area_light_samples_(area_light_samples) {}

  // One set and where its light goes. A value is the mean over `lanes_per_value` consecutive lanes (1, or 4
  // for the 2x2 box filter of pixel_quad_order); block b owns the 16 / lanes_per_value values from
  // b x 16 / lanes_per_value.
  struct Request {
    const SampleBlocks* samples;
    Lobes lobes;
    size_t lanes_per_value;
    std::span<glm::vec4> out;
  };

  // Adds the radiance of each light in turn to zero, or to what `out` holds. Lights of zero intensity cost
  // nothing. Logs stages "shadow_rays" and
  // "direct_shading", counters shadow_rays, shading_blocks and shading_blocks_culled; a radiance that is not
  // finite is counted (non_finite_direct_shading), warned of and replaced by zero (debug: an Error).
  // Parallel; the result does not depend on the number of threads.
  void shade(std::span<const Light> lights, const std::vector<Request>& requests, Onto onto, StageLog& log);
  int64_t bytes() const;

 private:
  struct NonFinite {
    int64_t count = 0;
    uint32_t first = SampleBlocks::no_sample;
  };
  void find_visible(const Emitter& light, const std::vector<Request>& requests, StageLog& log);
  void shade_emitter(const Emitter& light, const std::vector<Request>& requests, bool add,
                     NonFinite& bad) const;

  const RayTracer& tracer_;
  int area_light_samples_;
  std::vector<std::vector<uint16_t>> visible_;  // of the current emitter: a mask a block, for each request
};

}  // namespace relight
