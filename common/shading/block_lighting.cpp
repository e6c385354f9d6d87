#include "common/shading/block_lighting.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "common/shading/non_finite_report.h"
#include "common/shading/traced_visibility.h"
#include "common/tracing/ray_tracer.h"

namespace relight {
namespace {

using Range = tbb::blocked_range<size_t>;
constexpr size_t grain = 128;  // blocks: some ten microseconds of work

struct Work {
  int64_t rays = 0, culled = 0;
};

LaneMask unoccluded(const RayTracer& tracer, const SampleBlock& block, const Emitter& light, LaneMask lanes) {
  glm::vec3 origins[block_lanes];
  for (size_t i = 0; i < block_lanes; ++i) {
    const auto at = [i](const float(&v)[3][block_lanes]) { return glm::vec3(v[0][i], v[1][i], v[2][i]); };
    // A lit sample faces the light.
    origins[i] = tracer.offset_point(at(block.position), at(block.geometric_normal));
  }
  return visible16(tracer, origins, light, lanes);
}

void add_means(const BlockRgb& value, size_t lanes_per_value, bool add, glm::vec4* out) {
  const auto at = [&](size_t i) {
    return glm::vec4(value.rgb[0][i], value.rgb[1][i], value.rgb[2][i], 0.0f);
  };
  const auto put = [&](size_t v, const glm::vec4& x) { out[v] = add ? out[v] + x : x; };
  if (lanes_per_value == 1) {
    for (size_t i = 0; i < block_lanes; ++i) put(i, at(i));
  } else {
    for (size_t i = 0; i < block_lanes; i += 4)
      put(i / 4, ((at(i) + at(i + 1)) + (at(i + 2) + at(i + 3))) * 0.25f);
  }
}

void check(const BlockLighting::Request& r) {
  if (r.lanes_per_value != 1 && r.lanes_per_value != 4)
    throw std::logic_error("BlockLighting: lanes_per_value must be 1 or 4");
  if (r.out.size() < r.samples->count() * block_lanes / r.lanes_per_value)
    throw std::logic_error("BlockLighting: an output is smaller than its set of samples");
}

}  // namespace

void BlockLighting::shade(std::span<const Light> lights, const std::vector<Request>& requests, Onto onto,
                          StageLog& log) {
  std::for_each(requests.begin(), requests.end(), check);
  visible_.resize(requests.size());
  bool add = onto == Onto::what_is_there;
  NonFinite bad;
  for (const Light& light : lights) {
    if (light.intensity == glm::vec3(0.0f)) continue;
    require_no_shader(light, "direct lighting on the CPU");
    for (const Emitter& emitter : emitters_of(light, area_light_samples_, tracer_.offset())) {
      {
        const StageTimer timer(log, "shadow_rays");
        find_visible(emitter, requests, log);
      }
      const StageTimer timer(log, "direct_shading");
      shade_emitter(emitter, requests, add, bad);
      add = true;
    }
  }
  if (!add)
    for (const Request& r : requests) std::fill(r.out.begin(), r.out.end(), glm::vec4(0.0f));
  if (bad.count > 0) report_non_finite_shading(bad.count, bad.first, log);
}

void BlockLighting::find_visible(const Emitter& light, const std::vector<Request>& requests, StageLog& log) {
  const BlockCulling culling(light);
  for (size_t r = 0; r < requests.size(); ++r) {
    const SampleBlocks& samples = *requests[r].samples;
    std::vector<uint16_t>& visible = visible_[r];
    visible.resize(samples.count());
    const auto trace = [&](const Range& range, Work work) {
      for (size_t b = range.begin(); b < range.end(); ++b) {
        visible[b] = 0;
        if (!culling.may_be_lit(samples.bounds(b))) {
          ++work.culled;
          continue;
        }
        const LaneMask lit = lit_lanes(light, samples.geometry(b));
        if (lit == 0) continue;
        visible[b] = static_cast<uint16_t>(
            light.casts_shadows ? unoccluded(tracer_, samples.geometry(b), light, lit) : lit);
        if (light.casts_shadows) work.rays += std::popcount(lit);
      }
      return work;
    };
    const Work work = tbb::parallel_reduce(Range(0, samples.count(), grain), Work{}, trace,
                                           [](const Work& a, const Work& b) {
                                             return Work{a.rays + b.rays, a.culled + b.culled};
                                           });
    log.count("shadow_rays", work.rays);
    log.count("shading_blocks", static_cast<int64_t>(samples.count()));
    log.count("shading_blocks_culled", work.culled);
  }
}

void BlockLighting::shade_emitter(const Emitter& light, const std::vector<Request>& requests, bool add,
                                  NonFinite& bad) const {
  for (size_t r = 0; r < requests.size(); ++r) {
    const Request& request = requests[r];
    const SampleBlocks& samples = *request.samples;
    const size_t values = block_lanes / request.lanes_per_value;
    const auto shade_blocks = [&](const Range& range, NonFinite found) {
      for (size_t b = range.begin(); b < range.end(); ++b) {
        glm::vec4* out = request.out.data() + b * values;
        const LaneMask visible = visible_[r][b];
        if (visible == 0) {
          if (!add) std::fill(out, out + values, glm::vec4(0.0f));
          continue;
        }
        BlockRgb radiance;
        for (LaneMask rest = reflected(light, samples, b, request.lobes, visible, radiance); rest != 0;
             rest &= rest - 1) {
          ++found.count;
          found.first =
              std::min(found.first, samples.sample_index(b, static_cast<size_t>(std::countr_zero(rest))));
        }
        add_means(radiance, request.lanes_per_value, add, out);
      }
      return found;
    };
    const auto join = [](const NonFinite& a, const NonFinite& b) {
      return NonFinite{a.count + b.count, std::min(a.first, b.first)};
    };
    bad = join(bad, tbb::parallel_reduce(Range(0, samples.count(), grain), NonFinite{}, shade_blocks, join));
  }
}

int64_t BlockLighting::bytes() const {
  int64_t bytes = 0;
  for (const auto& masks : visible_) bytes += static_cast<int64_t>(masks.size() * sizeof(masks[0]));
  return bytes;
}

}  // namespace relight
