#include "methods/direct_to_indirect/precompute.h"

#include <optional>

#include "common/run/cached_artefact.h"
#include "common/run/error.h"
#include "common/sampling/environment_samples.h"
#include "methods/direct_to_indirect/column_scaling.h"
#include "methods/direct_to_indirect/environment_transfer.h"
#include "methods/direct_to_indirect/final_gather.h"
#include "methods/direct_to_indirect/gather_structure.h"
#include "methods/direct_to_indirect/glossy_rays.h"
#include "methods/direct_to_indirect/indirect_grid.h"
#include "methods/direct_to_indirect/light_points.h"
#include "methods/direct_to_indirect/multi_bounce.h"
#include "methods/direct_to_indirect/near_field.h"
#include "methods/direct_to_indirect/training_lights.h"
#include "methods/direct_to_indirect/view_basis.h"

namespace relight::direct_to_indirect {
namespace {

// Of near_field=cell_average.
constexpr int64_t points_a_cell = 8;

// The knob's value, or the number of all coefficients where it says 0.
int64_t kept_coefficients(const KnobValues& knobs, const std::string& knob) {
  const int64_t kept = knobs.integer(knob);
  return kept > 0 ? kept : knobs.integer("gather_samples");
}

int link_members(const KnobValues& knobs) {
  const std::string& members = knobs.choice("link_members");
  return members == "one" ? 1 : members == "two" ? 2 : members == "four" ? 4 : 0;
}

FinalGatherSettings final_gather_settings(const PrepareContext& context) {
  const KnobValues& knobs = context.knobs;
  FinalGatherSettings settings;
  settings.link_threshold = static_cast<float>(knobs.real("link_threshold"));
  settings.form_factor_clamp = static_cast<float>(knobs.real("form_factor_clamp"));
  settings.disc_elements = knobs.choice("near_field") == "disc";
  settings.link_members = link_members(knobs);
  settings.mean_elements = knobs.choice("link_element") == "mean";
  settings.coefficients = static_cast<int>(kept_coefficients(knobs, "coefficients"));
  settings.glossy_coefficients = static_cast<int>(kept_coefficients(knobs, "glossy_coefficients"));
  settings.energy_fraction = knobs.real("energy_fraction");
  settings.support_exponent = static_cast<float>(knobs.real("support_exponent"));
  settings.shared_budget = knobs.choice("row_budget") == "shared";
  settings.refit_ridge = static_cast<float>(knobs.real("refit_ridge"));
  settings.refit_candidates = static_cast<float>(knobs.real("refit_candidates"));
  settings.seed = context.seed;
  return settings;
}

MultiBounceSettings multi_bounce_settings(const PrepareContext& context) {
  const KnobValues& knobs = context.knobs;
  MultiBounceSettings settings;
  settings.kind = knobs.choice("multi_bounce") == "photons" ? BounceKind::photons : BounceKind::transfer;
  settings.bounces = bounces(knobs);
  settings.photons = knobs.integer("photons");
  settings.neighbours = static_cast<int>(knobs.integer("photon_neighbours"));
  settings.coefficients = static_cast<int>(kept_coefficients(knobs, "bounce_coefficients"));
  settings.gather = final_gather_settings(context);
  return settings;
}

EnvironmentSettings environment_settings(const PrepareContext& context) {
  const KnobValues& knobs = context.knobs;
  const auto kept = [&](const char* knob) {
    return static_cast<int>(knobs.integer(knob) > 0 ? knobs.integer(knob)
                                                    : knobs.integer("environment_samples"));
  };
  EnvironmentSettings settings;
  settings.samples = knobs.integer("environment_samples");
  settings.coefficients = kept("environment_coefficients");
  settings.gather_coefficients = kept("environment_gather_coefficients");
  settings.support_exponent = static_cast<float>(knobs.real("support_exponent"));
  settings.glossy_rays =
      knobs.choice("glossy") == "auto" ? static_cast<int>(knobs.integer("glossy_rays")) : 0;
  settings.seed = context.seed;
  return settings;
}

// Null where links alone are asked for.
std::unique_ptr<NearField> make_near_field(const PrepareContext& context, const GatherCloud& cloud,
                                           const GatherHierarchy& hierarchy) {
  const KnobValues& knobs = context.knobs;
  const std::string& kind = knobs.choice("near_field");
  if (kind != "cell_average" && kind != "hemisphere") return nullptr;
  StageTimer timer(context.log, "near_field");
  const NearFieldSettings settings{static_cast<float>(knobs.real("near_threshold")),
                                   static_cast<int>(knobs.integer("near_rays")), context.seed};
  std::vector<SurfaceSample> points;
  if (kind == "cell_average")
    points = make_cloud(context, points_a_cell * static_cast<int64_t>(cloud.samples.size()), context.seed + 1)
                 .samples;
  return std::make_unique<NearField>(context.tracer, cloud, hierarchy, settings, points);
}

// Settings that make no sense together; each alone is in range.
void check(const KnobValues& knobs) {
  EnvironmentSquare square(knobs.integer("environment_samples"));  // a power of four, or an Error
  for (const char* kept : {"coefficients", "glossy_coefficients"})
    if (knobs.integer(kept) == 0 && knobs.integer("refit_lights") > 0)
      fail(
          "direct_to_indirect.refit_lights: {} with {}=0: rows that keep every coefficient have nothing to "
          "refit; valid: 0",
          knobs.integer("refit_lights"), kept);
  if (knobs.choice("link_element") == "mean" && knobs.choice("column_scaling") != "none")
    fail(
        "direct_to_indirect.link_element: 'mean' with column_scaling={}, whose scaled elements have no mean; "
        "valid: member",
        knobs.choice("column_scaling"));
  if (knobs.choice("view_basis") != "haar") return;
  if (knobs.choice("row_budget") != "fixed")
    fail(
        "direct_to_indirect.row_budget: '{}' with view_basis=haar, whose tiles have a budget each; valid: "
        "fixed",
        knobs.choice("row_budget"));
  if (knobs.real("energy_fraction") < 1.0)
    fail(
        "direct_to_indirect.energy_fraction: {} with view_basis=haar, whose tiles share coefficients; valid: "
        "1",
        knobs.real("energy_fraction"));
}

Artefact precompute(const PrepareContext& context) {
  const KnobValues& knobs = context.knobs;
  Artefact artefact;
  GatherStructure structure = make_gather_structure(context);
  artefact.cloud = std::move(structure.cloud);
  artefact.light_points = std::move(structure.light_points);
  const GatherHierarchy& hierarchy = structure.hierarchy;
  const FinalGatherSettings settings = final_gather_settings(context);
  std::vector<float> scale;
  if (knobs.choice("column_scaling") == "mean_row") {
    StageTimer timer(context.log, "column_scaling");
    scale = mean_row_scaling(context.tracer, context.buffer, artefact.cloud, hierarchy, settings);
  }
  const MultiBounceSettings bounce_settings = multi_bounce_settings(context);
  if (bounce_settings.bounces > 1) {
    StageTimer timer(context.log, "multi_bounce");
    artefact.multi_bounce = compute_multi_bounce({context.tracer, artefact.cloud, hierarchy, scale},
                                                 bounce_settings, context.progress, context.log);
  }
  TrainingLights training;
  const auto lights = static_cast<uint32_t>(knobs.integer("refit_lights"));
  if (lights > 0) {
    StageTimer timer(context.log, "training_lights");
    training =
        make_training_lights(context.tracer, context.buffer, artefact.cloud, scale, lights, context.seed);
    context.log.bytes("training_lights", static_cast<int64_t>(training.response.size() * sizeof(float)));
  }
  const std::unique_ptr<NearField> near_field = make_near_field(context, artefact.cloud, hierarchy);
  const IndirectGrid grid(context.buffer, knobs);
  const std::optional<wavelet::PictureHaar> basis = view_basis(grid, knobs);
  std::optional<StageTimer> timer(std::in_place, context.log, "final_gather");
  const bool glossy = knobs.choice("glossy") == "auto" && !glossy_pixels(grid.samples()).empty();
  std::optional<GlossyRays> rays;
  if (glossy && knobs.choice("glossy_gather") == "rays")
    rays.emplace(context.tracer, artefact.cloud, static_cast<int>(knobs.integer("glossy_rays")),
                 context.seed);
  const GlossyGather glossy_gather{context.buffer.view.camera.eye, rays ? &*rays : nullptr};
  const FinalGatherInput input{context.tracer,
                               grid.samples(),
                               artefact.cloud,
                               hierarchy,
                               scale,
                               training,
                               near_field.get(),
                               knobs.choice("glossy") == "auto" ? &glossy_gather : nullptr,
                               grid.tiles(),
                               basis ? &*basis : nullptr};
  artefact.final_gather = compute_final_gather(input, settings, context.progress, context.log);
  timer.reset();
  if (wants_environment(context)) {
    const StageTimer environment_timer(context.log, "environment_transfer");
    artefact.environment =
        compute_environment_transfer({context.tracer, grid.samples(), artefact.cloud, grid.tiles()},
                                     environment_settings(context), context.progress, context.log);
  }
  for (size_t j = 0; j < scale.size(); ++j) artefact.cloud.samples[j].diffuse *= scale[j];
  if (!scale.empty())
    for (size_t p = 0; p < artefact.light_points.size(); ++p)
      artefact.light_points[p].diffuse *= scale[p / light_points_a_sample];
  return artefact;
}

}  // namespace

Artefact load_or_precompute(const PrepareContext& context) {
  check(context.knobs);
  return load_or_make(
      context, "direct_to_indirect.final_gather", cache_key(context), [&] { return precompute(context); },
      to_bytes, from_bytes);
}

}  // namespace relight::direct_to_indirect
