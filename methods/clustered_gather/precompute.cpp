#include "methods/clustered_gather/precompute.h"

#include "common/run/cached_artefact.h"
#include "common/run/error.h"
#include "common/sampling/environment_samples.h"

namespace relight::clustered_gather {
namespace {

ClusteringStart start(const KnobValues& knobs) {
  return knobs.choice("clustering") == "two_phase" ? ClusteringStart::hierarchical : ClusteringStart::random;
}

// View clusters, links and gather samples of one part of the reflection.
Links add_part(const PrepareContext& context, Part part, size_t clusters, GatherSamples& gather) {
  const KnobValues& knobs = context.knobs;
  const Metric6 metric(context.scene.bounds.diagonal(), static_cast<float>(knobs.real("normal_weight")));
  const int iterations = static_cast<int>(knobs.integer("iterations"));
  const std::string prefix = part == Part::glossy ? "glossy_" : "";
  std::vector<uint32_t> pixels = pixels_with(context.buffer, part);
  ViewClusters view;
  {
    StageTimer timer(context.log, prefix + "view_clusters");
    ClusteringSettings settings;
    settings.clusters = clusters;
    settings.start = start(knobs);
    settings.iterations = iterations;
    settings.seed = context.seed;
    view = cluster_view(context.buffer, pixels, metric, settings);
    context.log.count(prefix + "view_clusters", static_cast<int64_t>(view.samples.size()));
  }
  Links links;
  {
    StageTimer timer(context.log, prefix + "links");
    links = link_pixels(context.buffer, std::move(pixels), part, view, metric,
                        static_cast<int>(knobs.integer("neighbours")));
    // Numbers of clusters go on where those of the parts before end.
    const auto before = static_cast<uint32_t>(gather.first.size() - 1);
    for (uint32_t& k : links.cluster) k += before;
  }
  StageTimer timer(context.log, prefix + "gather_samples");
  GatherSettings settings;
  settings.directions = static_cast<int>(knobs.integer("directions"));
  settings.clusters = static_cast<size_t>(knobs.integer("gather_clusters"));
  settings.start = start(knobs);
  settings.iterations = iterations;
  settings.seed = context.seed;
  settings.part = part;
  settings.eye = context.buffer.view.camera.eye;
  if (wants_environment(context)) settings.environment_samples = knobs.integer("environment_samples");
  add_gather_samples(context.tracer, view, metric, settings, context.progress, context.log, gather);
  return links;
}

Artefact precompute(const PrepareContext& context) {
  const auto wanted = static_cast<size_t>(context.knobs.integer("view_clusters"));
  const bool glossy =
      context.knobs.choice("glossy") == "auto" && !pixels_with(context.buffer, Part::glossy).empty();
  const Split split = glossy ? split_by_energy(context.buffer, wanted) : Split{wanted, 0};
  Artefact artefact;
  artefact.diffuse = add_part(context, Part::diffuse, split.diffuse, artefact.gather);
  if (glossy) artefact.glossy = add_part(context, Part::glossy, split.glossy, artefact.gather);
  return artefact;
}

}  // namespace

Artefact load_or_precompute(const PrepareContext& context) {
  const EnvironmentSquare square(
      context.knobs.integer("environment_samples"));  // a power of four, or an Error
  return load_or_make(
      context, "clustered_gather.samples", cache_key(context), [&] { return precompute(context); }, to_bytes,
      from_bytes);
}

}  // namespace relight::clustered_gather
