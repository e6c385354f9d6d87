#include "methods/clustered_gather/precompute.h"

#include "common/run/artefact_cache.h"
#include "common/run/error.h"

namespace relight::clustered_gather {
namespace {

ClusteringStart start(const KnobValues& knobs) {
  return knobs.choice("clustering") == "two_phase" ? ClusteringStart::hierarchical : ClusteringStart::random;
}

Artefact precompute(const PrepareContext& context) {
  const KnobValues& knobs = context.knobs;
  const Metric6 metric(context.scene.bounds.diagonal(), static_cast<float>(knobs.real("normal_weight")));
  const int iterations = static_cast<int>(knobs.integer("iterations"));
  ViewClusters view;
  {
    StageTimer timer(context.log, "view_clusters");
    ClusteringSettings settings;
    settings.clusters = static_cast<size_t>(knobs.integer("view_clusters"));
    settings.start = start(knobs);
    settings.iterations = iterations;
    settings.seed = context.seed;
    view = cluster_view(context.buffer, metric, settings);
    context.log.count("view_clusters", static_cast<int64_t>(view.samples.size()));
  }
  Artefact artefact;
  {
    StageTimer timer(context.log, "links");
    artefact.links = link_pixels(context.buffer, view, metric, static_cast<int>(knobs.integer("neighbours")));
  }
  StageTimer timer(context.log, "gather_samples");
  GatherSettings settings;
  settings.directions = static_cast<int>(knobs.integer("directions"));
  settings.clusters = static_cast<size_t>(knobs.integer("gather_clusters"));
  settings.start = start(knobs);
  settings.iterations = iterations;
  settings.seed = context.seed;
  artefact.gather =
      make_gather_samples(context.tracer, view, metric, settings, context.progress, context.log);
  return artefact;
}

}  // namespace

Artefact load_or_precompute(const PrepareContext& context) {
  const std::string kind = "clustered_gather.samples", key = cache_key(context);
  {
    StageTimer timer(context.log, "cache_load");
    if (const auto bytes = context.cache.load(kind, key)) {
      context.log.count("cache_hits", 1);
      return from_bytes(*bytes);
    }
  }
  Artefact artefact = precompute(context);
  StageTimer timer(context.log, "cache_store");
  try {
    if (context.cache.enabled()) context.cache.store(kind, key, to_bytes(artefact));
  } catch (const Error& error) {
    context.log.warn(std::string("precomputed data was not cached: ") + error.what());
  }
  return artefact;
}

}  // namespace relight::clustered_gather
