#include "experiments/compare/not_simulated.h"

#include <algorithm>

#include <fmt/format.h>

namespace relight {

std::vector<std::string> not_simulated(const LightPaths& paths, const Scene& scene,
                                       const LightingState& lighting) {
  std::vector<std::string> sentences;
  if (paths.min_bounces > 1) {
    sentences.push_back(fmt::format("indirect light of fewer than {} bounces", paths.min_bounces));
  }
  sentences.push_back(fmt::format("indirect light of more than {} bounce{}", paths.max_bounces,
                                  paths.max_bounces == 1 ? "" : "s"));
  const auto glossy = std::count_if(scene.materials.begin(), scene.materials.end(),
                                    [](const Material& m) { return m.is_glossy(); });
  const std::string share =
      fmt::format("{} of the scene's {} materials are glossy", glossy, scene.materials.size());
  if (glossy > 0 && !paths.glossy_at_eye) {
    sentences.push_back(
        fmt::format("glossy reflection of indirect light at the visible surface ({})", share));
  }
  if (glossy > 0 && !paths.glossy_interior) {
    sentences.push_back(fmt::format("glossy reflection at the surfaces behind the visible one ({})", share));
  }
  const std::string sky = lighting.environment ? "light from the sky" : "light from the scene's environment";
  const bool environment = !lighting.environment_or(scene.environment).black();
  if (environment && !paths.environment) {
    sentences.push_back(sky);
  } else if (environment && paths.last_environment_bounce() < paths.max_bounces) {
    sentences.push_back(fmt::format("{} after more than {} bounces", sky, paths.last_environment_bounce()));
  }
  const auto emitters = std::count_if(scene.materials.begin(), scene.materials.end(),
                                      [](const Material& m) { return m.emission != glm::vec3(0.0f); });
  if (emitters > 0 && !paths.emission) {
    sentences.push_back(fmt::format("light emitted by surfaces ({} emitting materials)", emitters));
  }
  return sentences;
}

}  // namespace relight
