// The matrices of the environment's light on a small view, without a method around them. The view samples are
// the gather samples, too.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "common/sampling/environment_samples.h"
#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/environment_transfer.h"
#include "tests/reference/skies.h"
#include "tests/support/tiny_scenes.h"

namespace relight::direct_to_indirect {

struct EnvironmentSetup {
  Scene scene;
  RayTracer tracer;
  DeepFrameBuffer buffer;
  GatherCloud cloud;

  explicit EnvironmentSetup(Scene s, int width = 24, int height = 16)
      : scene(std::move(s)),
        tracer(scene),
        buffer(make_deep_frame_buffer(scene, tracer, {scene.camera, width, height})) {
    cloud.samples = buffer.indirect;
    cloud.area.assign(cloud.samples.size(), 1.0f);
  }

  EnvironmentTransfer transfer(const EnvironmentSettings& settings, StageLog& log) const {
    Progress quiet(true);
    return compute_environment_transfer({tracer, buffer, cloud}, settings, quiet, log);
  }
  EnvironmentTransfer transfer(const EnvironmentSettings& settings) const {
    StageLog log;
    return transfer(settings, log);
  }
  // Rows times the radiances of an environment; of the diffuse matrices irradiance / pi.
  std::vector<glm::dvec3> light(const SparseRows& rows, const Environment& environment) const {
    const std::vector<glm::dvec3> coefficients =
        wavelet::forward(mean_radiance(environment, EnvironmentSquare(rows.columns)));
    std::vector<glm::dvec3> out;
    for (const glm::vec3& v : multiply(rows, coefficients)) out.emplace_back(v);
    return out;
  }
};

inline EnvironmentSettings environment_settings(int64_t samples, int coefficients) {
  EnvironmentSettings settings;
  settings.samples = samples;
  settings.coefficients = settings.gather_coefficients = coefficients;
  return settings;
}

// Of the values of one channel.
struct Spread {
  double lowest = INFINITY, highest = -INFINITY, mean = 0.0;
  Spread(const std::vector<glm::dvec3>& values, int channel) {
    for (const glm::dvec3& v : values) {
      lowest = std::min(lowest, v[channel]), highest = std::max(highest, v[channel]);
      mean += v[channel] / static_cast<double>(values.size());
    }
  }
};

}  // namespace relight::direct_to_indirect
