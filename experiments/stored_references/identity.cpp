#include "experiments/stored_references/identity.h"

#include <fmt/format.h>

#include "common/lights/light_words.h"
#include "experiments/compare/reference_images.h"
#include "experiments/options/parse.h"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

std::string words(const glm::vec3& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

Json lights_json(const LightingState& lighting) {
  Json lights = Json::array();
  for (const Light& light : lighting.lights) lights.push_back(describe(light));
  return lights;
}

}  // namespace

SessionOptions stored_session_options(const StoredReference& reference) {
  SessionOptions options;
  options.scene = reference.scene;
  options.lights = reference.lights;
  options.view = stored_view;
  options.no_cache = true;
  return options;
}

BatchPlan stored_plan(const StoredReference& reference) {
  BatchPlan plan;
  plan.paths = reference.paths;
  plan.batches = stored_batches;
  plan.samples_per_batch = reference.samples_per_batch;
  plan.seed = stored_seed;
  return plan;
}

Json picture_identity(const StoredReference& reference, const Session& session) {
  const BatchPlan plan = stored_plan(reference);
  const Camera& camera = session.buffer().view.camera;
  return {
      {"scene", reference.scene},
      {"scene_hash", fmt::format("{:016x}", session.scene().content_hash)},
      {"lights", reference.lights},
      {"lights_in_words", lights_json(session.lighting())},
      {"camera", fmt::format("eye {} target {} up {} vertical field of view {} degrees", words(camera.eye),
                             words(camera.target), words(camera.up), camera.fov_y_degrees)},
      {"view", stored_view},
      {"light_paths", plan.paths.to_string()},
      {"estimator", to_string(plan.estimator)},
      {"batches", plan.batches},
      {"samples_per_batch", plan.samples_per_batch},
      {"seed", plan.seed},
      {"reference_version", reference_version}};
}

std::vector<std::string> stale_fields(const Json& stored, const Json& now) {
  std::vector<std::string> lines;
  for (const auto& [field, value] : now.items()) {
    const Json before = stored.is_object() ? stored.value(field, Json()) : Json();
    if (before != value)
      lines.push_back(fmt::format("{}: stored {}, now {}", field, before.dump(), value.dump()));
  }
  return lines;
}

}  // namespace relight
