#include "methods/direct_to_indirect/gather_structure.h"

#include <fmt/format.h>

#include "common/run/artefact_cache.h"
#include "methods/direct_to_indirect/artefact.h"
#include "methods/direct_to_indirect/light_points.h"

namespace relight::direct_to_indirect {
namespace {

constexpr const char* kind = "direct_to_indirect.gather_cloud";

bool has_light_points(const KnobValues& knobs) { return knobs.choice("light_points") != "1"; }

// Of the cloud that is made and ordered: gather samples, or their light points.
int64_t points(const KnobValues& knobs) {
  return knobs.integer("gather_samples") *
         (has_light_points(knobs) ? static_cast<int64_t>(light_points_a_sample) : 1);
}

std::string cloud_key(const PrepareContext& context) {
  const KnobValues& knobs = context.knobs;
  return fmt::format("{};points={};cloud={};hierarchy_k={};bounces={};glossy={}", view_key(context),
                     points(knobs), knobs.choice("cloud"), knobs.real("hierarchy_k"), bounces(knobs),
                     knobs.choice("glossy"));
}

GatherCloud make_ordered_cloud(const PrepareContext& context) {
  const KnobValues& knobs = context.knobs;
  GatherCloud cloud;
  {
    StageTimer timer(context.log, "gather_cloud");
    cloud = make_cloud(context, points(knobs), context.seed);
  }
  StageTimer timer(context.log, "hierarchy");
  order_gather_cloud(cloud, static_cast<float>(knobs.real("hierarchy_k")), context.scene.bounds.diagonal());
  return cloud;
}

// From the parts that were kept, or made and kept.
GatherCloud ordered_cloud(const PrepareContext& context) {
  if (!context.parts) return make_ordered_cloud(context);
  const std::string key = cloud_key(context);
  if (const auto bytes = context.parts->load(kind, key)) return from_bytes(*bytes).cloud;
  Artefact artefact;
  artefact.cloud = make_ordered_cloud(context);
  artefact.final_gather.diffuse.columns = static_cast<uint32_t>(artefact.cloud.samples.size());
  context.parts->store(kind, key, to_bytes(artefact));
  return std::move(artefact.cloud);
}

}  // namespace

int bounces(const KnobValues& knobs) { return static_cast<int>(knobs.integer("bounces")); }

GatherCloud make_cloud(const PrepareContext& context, int64_t samples, uint64_t seed) {
  const KnobValues& knobs = context.knobs;
  const CloudView view{context.buffer, bounces(knobs), knobs.choice("glossy") == "auto"};
  const bool importance = knobs.choice("cloud") == "importance";
  return make_gather_cloud_for_view(
      context.tracer, view, importance ? CloudSampling::importance : CloudSampling::uniform, samples, seed);
}

GatherStructure make_gather_structure(const PrepareContext& context) {
  GatherStructure structure;
  structure.cloud = ordered_cloud(context);
  if (has_light_points(context.knobs)) {
    GatherCloud samples = gather_samples_of(structure.cloud);
    structure.light_points = std::move(structure.cloud.samples);
    structure.cloud = std::move(samples);
  }
  StageTimer timer(context.log, "hierarchy");
  structure.hierarchy = build_hierarchy(structure.cloud);
  return structure;
}

}  // namespace relight::direct_to_indirect
