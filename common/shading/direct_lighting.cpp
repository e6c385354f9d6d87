#include "common/shading/direct_lighting.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

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
constexpr int radiance_binding = 1, visibility_binding = 2, report_binding = 3;
constexpr int samples_unit = 1, shapes_unit = 2, slide_unit = 3;  // ShadowMaps has texture unit 0

// What a set needs of the shader; unused code is left out, because a software rasteriser runs both sides of
// every branch.
enum class Variant { diffuse, phong, all_models };

Variant variant_of(const DirectLighting::Request& request) {
  if (request.lobes == Lobes::diffuse || !request.samples->has_glossy()) return Variant::diffuse;
  return request.samples->has_shapes() ? Variant::all_models : Variant::phong;
}

// Which code a set and a light need.
struct ProgramKey {
  Variant variant;
  SampleFormat format;
  bool beam;
  uint64_t user_shader;  // its content; 0: none
  auto operator<=>(const ProgramKey&) const = default;
};

gpu::Program compile(const ProgramKey& key, Shadows shadows, const UserLight* user) {
  const Variant variant = key.variant;
  std::vector<gpu::ReplacedFile> replaced;
  if (user) replaced.push_back({"common/lights/user_light.glsl", user->shader->file, user->shader->text});
  return gpu::Program::compute(
      "common/shading/direct_lighting.glsl",
      {shadows == Shadows::map ? "SHADOW_MAPS 1" : "SHADOW_MAPS 0", key.beam ? "BEAM 1" : "BEAM 0",
       user ? "USER_LIGHT 1" : "USER_LIGHT 0", variant == Variant::diffuse ? "ALL_LOBES 0" : "ALL_LOBES 1",
       variant == Variant::all_models ? "SHAPES 1" : "SHAPES 0",
       fmt::format("FORMAT {}", static_cast<int>(key.format))},
      replaced);
}

// A slide as shaders read it.
struct SlideTexels {
  gpu::Buffer texels;
  gpu::TexelView view;
  explicit SlideTexels(const Slide& slide)
      : texels(gpu::Buffer::from(slide.texels)), view(texels, gpu::TexelView::Format::rgba32f) {}
};

void set_beam(const gpu::Program& program, const shader::BeamParams& beam) {
  program.set("beam_right_width", beam.right_width);
  program.set("beam_up_height", beam.up_height);
  program.set("beam_forward_roundness", beam.forward_roundness);
  program.set("beam_edges_shear", beam.edges_shear);
  program.set("beam_cuts", beam.cuts);
  program.set("beam_falloff_slide", beam.falloff_slide);
}

// A user's shader may leave parameters unused, whose uniforms then don't exist.
void set_user_light(const gpu::Program& program, const UserLight& user) {
  for (size_t i = 0; i < user.parameters.size(); ++i)
    program.set_if_used("user_parameters[" + std::to_string(i) + "]", user.parameters[i]);
  program.set_if_used("user_right", user.axes[0]);
  program.set_if_used("user_up", user.axes[1]);
  program.set_if_used("user_forward", user.axes[2]);
}

}  // namespace

struct DirectLighting::Impl {
  gpu::Context& gpu;
  const RayTracer& tracer;
  DirectLightingSettings settings;
  std::optional<ShadowMaps> maps;
  std::map<ProgramKey, gpu::Program> programs;  // compiled when first needed
  std::map<uint64_t, SlideTexels> slides;       // on the GPU, by content
  gpu::Buffer report{2 * sizeof(uint32_t)};

  Impl(gpu::Context& context, const Scene& scene, const RayTracer& ray_tracer,
       const DirectLightingSettings& s)
      : gpu(context), tracer(ray_tracer), settings(s) {
    if (s.shadows == Shadows::map) maps.emplace(scene, s.shadow_map_size);
  }

  const gpu::Program& program_for(const Request& request, const Emitter& light);
  void bind_slide(const Slide& slide);
  void shade_emitter(const Emitter& light, bool first, const std::vector<Request>& requests, StageLog& log);
  void set_light(const gpu::Program& program, const Emitter& light, bool first) const;
  void shade_set(const gpu::Program& program, const Request& request, const gpu::Buffer* visibility) const;
  std::vector<gpu::Buffer> trace(const Emitter& light, const std::vector<Request>& requests,
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
  shade(lighting.lights, requests, Onto::nothing, log);
}

void DirectLighting::shade(std::span<const Light> lights, const std::vector<Request>& requests, Onto onto,
                           StageLog& log) {
  impl_->gpu.make_current();
  for (const Request& r : requests) {
    if (r.out->bytes() < static_cast<int64_t>(r.samples->size() * sizeof(glm::vec4))) {
      throw std::logic_error("DirectLighting::shade: an output buffer is smaller than 16 bytes a sample");
    }
  }
  const uint32_t nothing[2] = {0, no_index};
  impl_->report.upload(0, sizeof(nothing), nothing);
  bool first = onto == Onto::nothing;
  for (const Light& light : lights) {
    if (light.intensity == glm::vec3(0.0f)) continue;
    for (const Emitter& emitter :
         emitters_of(light, impl_->settings.area_light_samples, impl_->tracer.offset())) {
      impl_->shade_emitter(emitter, first, requests, log);
      first = false;
    }
  }
  if (first) {
    for (const Request& r : requests) r.out->clear();
  }
  impl_->check_report(log);
  gpu::check_gl("direct lighting");
}

void DirectLighting::Impl::shade_emitter(const Emitter& light, bool first,
                                         const std::vector<Request>& requests, StageLog& log) {
  if (light.beam) bind_slide(*light.beam->slide);
  std::vector<gpu::Buffer> visibility;
  LightFrame frame;
  if (light.casts_shadows && maps) {
    const StageTimer timer(log, "shadow_maps");
    frame = maps->render(light);
    log.count("shadow_maps_rendered", frame.faces);
    gpu::finish();
  } else if (light.casts_shadows) {
    const StageTimer timer(log, "shadow_rays");
    visibility = trace(light, requests, log);
  }
  const StageTimer timer(log, "direct_shading");
  for (size_t i = 0; i < requests.size(); ++i) {
    const gpu::Program& program = program_for(requests[i], light);
    set_light(program, light, first);
    if (light.casts_shadows && maps) maps->bind(program, frame, tracer.offset());
    shade_set(program, requests[i], visibility.empty() ? nullptr : &visibility[i]);
    log.count("shader_invocations", static_cast<int64_t>(requests[i].samples->size()));
  }
  gpu::finish();
}

const gpu::Program& DirectLighting::Impl::program_for(const Request& request, const Emitter& light) {
  const ProgramKey key{variant_of(request), request.samples->format(), light.beam != nullptr,
                       light.user ? light.user->shader->content_hash : 0};
  const auto found = programs.find(key);
  if (found != programs.end()) return found->second;
  return programs.emplace(key, compile(key, settings.shadows, light.user.get())).first->second;
}

void DirectLighting::Impl::bind_slide(const Slide& slide) {
  auto found = slides.find(slide.content_hash);
  if (found == slides.end()) found = slides.emplace(slide.content_hash, slide).first;
  found->second.view.bind(slide_unit);
}

std::vector<gpu::Buffer> DirectLighting::Impl::trace(const Emitter& light,
                                                     const std::vector<Request>& requests,
                                                     StageLog& log) const {
  std::vector<gpu::Buffer> visibility;
  int64_t rays = 0;
  for (const Request& r : requests) {
    if (r.samples->host().size() != r.samples->size())
      throw std::logic_error("DirectLighting: traced shadows of samples that the host has dropped");
    visibility.push_back(gpu::Buffer::from(traced_visibility(tracer, r.samples->host(), light, rays)));
  }
  log.count("shadow_rays", rays);
  return visibility;
}

void DirectLighting::Impl::set_light(const gpu::Program& program, const Emitter& light, bool first) const {
  program.set("light_position_type", light.params.position_type);
  program.set("light_direction_outer", light.params.direction_outer);
  program.set("light_intensity_inner", light.params.intensity_inner);
  if (light.beam) set_beam(program, light.beam->params);
  if (light.user) set_user_light(program, *light.user);
  program.set("first_light", first ? 1 : 0);
  program.set("shadowed", light.casts_shadows ? 1 : 0);
}

void DirectLighting::Impl::shade_set(const gpu::Program& program, const Request& request,
                                     const gpu::Buffer* visibility) const {
  const Variant variant = variant_of(request);
  if (variant != Variant::diffuse) program.set("eye", request.samples->eye());
  if (request.samples->format() != SampleFormat::full) {
    program.set("frame", request.samples->frame());
    if (request.samples->format() == SampleFormat::half) program.set("unit", request.samples->unit());
  }
  report.bind_storage(report_binding);
  for (const GpuSamples::Slab& slab : request.samples->slabs()) {
    slab.data.bind(samples_unit);
    if (variant == Variant::all_models) slab.shapes.bind(shapes_unit);
    request.out->bind_storage(radiance_binding, slab.first * 16, slab.count * 16);
    if (visibility) visibility->bind_storage(visibility_binding, slab.first / 8, (slab.count + 31) / 32 * 4);
    program.set("sample_count", static_cast<uint32_t>(slab.count));
    program.set("first_sample", static_cast<uint32_t>(slab.first));
    program.dispatch_items(slab.count, local_size);
  }
}

void DirectLighting::Impl::check_report(StageLog& log) const {
  const std::vector<uint32_t> found = report.download<uint32_t>();
  if (found[0] == 0) return;
  report_non_finite_shading(found[0], found[1], log);
}

}  // namespace relight
