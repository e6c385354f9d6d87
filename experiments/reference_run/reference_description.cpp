#include "experiments/reference_run/reference_description.h"

#include <fmt/format.h>

#include "common/run/provenance.h"
#include "experiments/options/parse.h"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

Json floor_json(const MetricSet& floor) {
  return {{"relative", floor.relative},
          {"relative_edges_out", floor.relative_edges_out},
          {"relative_hdr", floor.relative_hdr},
          {"rmse", floor.rmse},
          {"relmse", floor.relmse},
          {"ssim", floor.ssim}};
}

// Mean radiance of the picture by path class.
Json layers_json(const PathTracerResult& result) {
  Json layers = Json::object();
  for (const PathLayer& layer : result.layers) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& p : layer.mean.pixels) sum += glm::dvec3(p);
    sum /= static_cast<double>(layer.mean.pixels.size());
    layers[layer.path_class.name()] = {sum.x, sum.y, sum.z};
  }
  return layers;
}

}  // namespace

Json describe_reference(const Session& session, const PathTracerSettings& settings,
                        const PathTracerResult& result, const ErrorReport& report) {
  const Provenance p = collect_provenance("", "");
  Json json = {{"scene", session.options().scene},
               {"scene_hash", fmt::format("{:016x}", session.scene().content_hash)},
               {"view", to_string(parse_view(session.options().view))},
               {"lighting", session.lighting_name()},
               {"light_paths", settings.paths.to_string()},
               {"pattern", settings.pattern},
               {"estimator", to_string(settings.estimator)},
               {"seed", settings.seed},
               {"samples_per_pixel", result.samples_per_pixel},
               {"batches", result.batches},
               {"rays", result.rays},
               {"non_finite", result.non_finite},
               {"firefly_pixels", result.fireflies},
               {"seconds", result.seconds},
               {"exposure", session.scene().exposure},
               {"relative_standard_error", result.relative_standard_error},
               {"noise_floor", floor_json(report.noise_floor)},
               {"edge_share", report.edge_share}};
  if (!result.layers.empty()) json["mean_radiance_by_class"] = layers_json(result);
  json["provenance"] = {{"commit", p.commit},
                        {"compiler", p.compiler},
                        {"cpu", p.cpu},
                        {"threads", p.threads},
                        {"date", p.date}};
  return json;
}

}  // namespace relight
