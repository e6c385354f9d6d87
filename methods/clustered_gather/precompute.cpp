#include "methods/clustered_gather/precompute.h"

#include "common/run/cached_artefact.h"
#include "common/run/error.h"
#include "common/sampling/environment_samples.h"
#include "common/shading/reconstruction.h"

namespace relight::clustered_gather {
namespace {

ClusteringStart start(const KnobValues& knobs) {
  return knobs.choice("clustering") == "two_phase" ? ClusteringStart::hierarchical : ClusteringStart::random;
}

// View clusters that the pixels asked for take light from, through the 3x3 upsampling; empty: all.
std::vector<uint8_t> used_clusters(const DeepFrameBuffer& buffer, const Links& links, size_t clusters) {
  if (buffer.wanted.empty()) return {};
  std::vector<uint8_t> sources(buffer.indirect.size(), 0), used(clusters, 0);
  const std::vector<uint32_t> closest = closest_view_samples(buffer);
  const auto width = static_cast<size_t>(buffer.view.width);
  for (size_t i = 0; i < closest.size(); ++i) {
    const size_t x = i % (2 * width) / 2, y = i / (2 * width) / 2;
    if (buffer.wanted[y * width + x] && closest[i] < sources.size()) sources[closest[i]] = 1;
  }
  for (size_t i = 0; i < links.cluster.size(); ++i)
    if (links.weight[i] > 0.0f && sources[links.pixel[i / links.per_pixel]]) used[links.cluster[i]] = 1;
  return used;
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
  std::vector<uint8_t> used;
  {
    StageTimer timer(context.log, prefix + "links");
    links = link_pixels(context.buffer, std::move(pixels), part, view, metric,
                        static_cast<int>(knobs.integer("neighbours")));
    used = used_clusters(context.buffer, links, view.samples.size());
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
  settings.used = used;
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
