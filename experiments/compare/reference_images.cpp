#include "experiments/compare/reference_images.h"

#include <chrono>

#include "common/lights/light_words.h"
#include "common/run/error.h"
#include "common/run/making_log.h"
#include "experiments/compare/result_bytes.h"
#include "experiments/options/parse.h"

namespace relight {

namespace {

constexpr const char* kind = "reference.images";

std::string words(const glm::vec3& v) { return fmt::format("({},{},{})", v.x, v.y, v.z); }

std::string words(const LightPaths& paths) {
  std::string out = fmt::format("bounces={}..{} glossy_eye={} glossy_interior={} environment={} emission={}",
                                paths.min_bounces, paths.max_bounces, paths.glossy_at_eye,
                                paths.glossy_interior, paths.environment, paths.emission);
  // Absent without an environment, so that older pictures keep their keys.
  if (paths.environment) out += fmt::format(" environment_bounces={}", paths.last_environment_bounce());
  return out;
}

}  // namespace

bool same_paths(const LightPaths& a, const LightPaths& b) { return words(a) == words(b); }

std::string reference_key(const Session& session, const PathTracerSettings& settings) {
  return fmt::format("{} samples={} batches={}", picture_key(session, settings), settings.samples_per_pixel,
                     settings.batches);
}

std::string picture_key(const Session& session, const PathTracerSettings& settings) {
  const View& view = session.buffer().view;
  std::string lights;
  bool area = false;
  for (const Light& light : session.lighting().lights) {
    lights += fmt::format("[{}]", describe(light));
    area = area || has_area(light.type);
  }
  // Absent without such lights, so that older pictures keep their keys.
  if ((area || settings.paths.environment) && settings.paths.min_bounces >= 1)
    lights += fmt::format(" area_samples={}", settings.area_samples);
  return fmt::format(
      "version={} float=binary32 scene={:016x} eye={} target={} up={} fov_y={} view={}x{} lights={} {} "
      "estimator={} seed={} classes={} pattern='{}' extended={}",
      reference_version, session.scene().content_hash, words(view.camera.eye), words(view.camera.target),
      words(view.camera.up), view.camera.fov_y_degrees, view.width, view.height, lights,
      words(settings.paths), to_string(settings.estimator), settings.seed, settings.class_bounces,
      settings.pattern, settings.sample_extended_lights);
}

ReferenceImages reference_images(Session& session, const PathTracerSettings& settings, StageLog& log) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const View& view = session.buffer().view;
  const bool repeatable = settings.time_limit_s <= 0.0;
  const std::string key = reference_key(session, settings), log_kind = std::string(kind) + ".log";
  if (repeatable) {
    if (const auto bytes = session.cache().load(kind, key)) {
      if (auto result = result_from_bytes(*bytes, view.width, view.height)) {
        ReferenceImages found{settings, std::move(*result), true, elapsed(), {}};
        // Pictures of older programs have no log.
        const auto log_bytes = session.cache().load(log_kind, key);
        if (const auto made = log_bytes ? making_log_from_bytes(*log_bytes) : std::nullopt)
          found.warnings = made->log.warnings();
        return found;
      }
    }
  }
  MakingLog made;
  PathTracerResult result = path_trace(session.tracer(), session.buffer(), session.lighting(), settings,
                                       session.progress(), made.log);
  made.seconds = elapsed();
  if (repeatable && session.cache().enabled()) {
    try {
      session.cache().store(log_kind, key, to_bytes(made));
      session.cache().store(kind, key, to_bytes(result));
    } catch (const Error& error) {
      log.warn(fmt::format("the reference was not cached: {}", error.what()));
    }
  }
  return {settings, std::move(result), false, elapsed(), made.log.warnings()};
}

}  // namespace relight
