#include "common/shading/direct_lighting.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "common/gpu/program.h"
#include "common/gpu/timer.h"
#include "common/shading/non_finite_report.h"
#include "common/shading/shadow_maps.h"
#include "common/shading/traced_visibility.h"
#include "common/tracing/ray_tracer.h"

namespace relight {
namespace {

constexpr int local_size = 64;
constexpr uint32_t no_index = std::numeric_limits<uint32_t>::max();
constexpr int samples_binding = 0, radiance_binding = 1, visibility_binding = 2, report_binding = 3,
              shapes_binding = 4;

}  // namespace

struct DirectLighting::Impl {
  gpu::Context& gpu;
  const RayTracer& tracer;
  DirectLightingSettings settings;
  std::optional<ShadowMaps> maps;
  gpu::Program program;
  gpu::Buffer report{2 * sizeof(uint32_t)};
  int64_t slab;  // samples that one dispatch can bind

  Impl(gpu::Context& context, const Scene& scene, const RayTracer& ray_tracer,
       const DirectLightingSettings& s)
      : gpu(context),
        tracer(ray_tracer),
        settings(s),
        program(gpu::Program::compute("common/shading/direct_lighting.glsl",
                                      {s.shadows == Shadows::map ? "SHADOW_MAPS 1" : "SHADOW_MAPS 0"})) {
    if (s.shadows == Shadows::map) maps.emplace(scene, s.shadow_map_size);
    // 64 bytes a sample; a multiple of 8192 samples keeps every range aligned, the visibility bits' too.
    slab = std::max<int64_t>(gpu.max_storage_block_bytes() / 64 / 8192, 1) * 8192;
  }

  void shade_light(const Light& light, bool first, const std::vector<Request>& requests, StageLog& log);
  void set_light(const Light& light, bool first);
  void shade_set(const Request& request, const gpu::Buffer* visibility);
  std::vector<gpu::Buffer> trace(const Light& light, const std::vector<Request>& requests,
                                 StageLog& log) const;
  void check_report(StageLog& log) const;
};

DirectLighting::DirectLighting(gpu::Context& gpu, const Scene& scene, const RayTracer& tracer,
                               DirectLightingSettings settings) {
  gpu.make_current();
  impl_ = std::make_unique<Impl>(gpu, scene, tracer, settings);
}

DirectLighting::~DirectLighting() = default;

int64_t DirectLighting::bytes() const { return impl_->maps ? impl_->maps->bytes() : 0; }

void DirectLighting::shade(const LightingState& lighting, const std::vector<Request>& requests,
                           StageLog& log) {
  impl_->gpu.make_current();
  for (const Request& r : requests) {
    if (r.out->bytes() < static_cast<int64_t>(r.samples->size() * sizeof(glm::vec4))) {
      throw std::logic_error("DirectLighting::shade: an output buffer is smaller than 16 bytes a sample");
    }
  }
  const uint32_t nothing[2] = {0, no_index};
  impl_->report.upload(0, sizeof(nothing), nothing);
  bool first = true;
  for (const Light& light : lighting.lights) {
    if (light.intensity == glm::vec3(0.0f)) continue;
    require_omni_or_spot(light);
    impl_->shade_light(light, first, requests, log);
    first = false;
  }
  if (first) {
    for (const Request& r : requests) r.out->clear();
  }
  impl_->check_report(log);
  gpu::check_gl("direct lighting");
}

void DirectLighting::Impl::shade_light(const Light& light, bool first, const std::vector<Request>& requests,
                                       StageLog& log) {
  std::vector<gpu::Buffer> visibility;
  if (light.casts_shadows && maps) {
    const StageTimer timer(log, "shadow_maps");
    const LightFrame frame = maps->render(light);
    maps->bind(program, frame, tracer.offset());
    log.count("shadow_maps_rendered", frame.faces);
    gpu::finish();
  } else if (light.casts_shadows) {
    const StageTimer timer(log, "shadow_rays");
    visibility = trace(light, requests, log);
  }
  const StageTimer timer(log, "direct_shading");
  set_light(light, first);
  for (size_t i = 0; i < requests.size(); ++i) {
    shade_set(requests[i], visibility.empty() ? nullptr : &visibility[i]);
    log.count("shader_invocations", static_cast<int64_t>(requests[i].samples->size()));
  }
  gpu::finish();
}

std::vector<gpu::Buffer> DirectLighting::Impl::trace(const Light& light, const std::vector<Request>& requests,
                                                     StageLog& log) const {
  std::vector<gpu::Buffer> visibility;
  int64_t rays = 0;
  for (const Request& r : requests) {
    visibility.push_back(gpu::Buffer::from(traced_visibility(tracer, r.samples->host(), light, rays)));
  }
  log.count("shadow_rays", rays);
  return visibility;
}

void DirectLighting::Impl::set_light(const Light& light, bool first) {
  const shader::LightParams params = light.params();
  program.set("light_position_type", params.position_type);
  program.set("light_direction_outer", params.direction_outer);
  program.set("light_intensity_inner", params.intensity_inner);
  program.set("first_light", first ? 1 : 0);
  program.set("shadowed", light.casts_shadows ? 1 : 0);
}

void DirectLighting::Impl::shade_set(const Request& request, const gpu::Buffer* visibility) {
  const auto size = static_cast<int64_t>(request.samples->size());
  program.set("eye", request.samples->eye());
  program.set("all_lobes", request.lobes == Lobes::all ? 1 : 0);
  program.set("has_shapes", request.samples->has_shapes() ? 1 : 0);
  report.bind_storage(report_binding);
  for (int64_t begin = 0; begin < size; begin += slab) {
    const int64_t count = std::min(slab, size - begin);
    request.samples->bind_range(samples_binding, shapes_binding, begin, count);
    request.out->bind_storage(radiance_binding, begin * 16, count * 16);
    if (visibility) visibility->bind_storage(visibility_binding, begin / 8, (count + 31) / 32 * 4);
    program.set("sample_count", static_cast<uint32_t>(count));
    program.set("first_sample", static_cast<uint32_t>(begin));
    program.dispatch_items(count, local_size);
  }
}

void DirectLighting::Impl::check_report(StageLog& log) const {
  const std::vector<uint32_t> found = report.download<uint32_t>();
  if (found[0] == 0) return;
  report_non_finite_shading(found[0], found[1], log);
}

}  // namespace relight
