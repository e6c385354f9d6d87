#include "experiments/reference_run/reference_run.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "common/image/exr.h"
#include "common/image/metrics.h"
#include "common/run/atomic_file.h"
#include "common/run/provenance.h"
#include "experiments/compare/reference_images.h"
#include "experiments/options/parse.h"
#include "experiments/session/output_folder.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

PathTracerSettings settings_of(const ReferenceOptions& options) {
  const BounceRange bounces = parse_bounces(options.bounces);
  if (options.glossy != "none" && options.glossy != "eye" && options.glossy != "all") {
    usage_fail("--glossy '{}': valid: none, eye, all", options.glossy);
  }
  require_samples("--samples", options.samples);
  if (!(options.time_limit_s >= 0.0) || std::isinf(options.time_limit_s)) {
    usage_fail("--time {}: expected a number of seconds, 0 for no limit", options.time_limit_s);
  }
  PathTracerSettings settings;
  settings.paths.min_bounces = bounces.min;
  settings.paths.max_bounces = bounces.max;
  settings.paths.glossy_at_eye = options.glossy != "none";
  settings.paths.glossy_interior = options.glossy == "all";
  settings.samples_per_pixel = options.samples;
  settings.estimator = parse_estimator(options.estimator);
  settings.seed = options.session.seed;
  settings.time_limit_s = options.time_limit_s;
  return settings;
}

Json floor_json(const MetricSet& floor) {
  return {{"relative", floor.relative},
          {"relative_edges_out", floor.relative_edges_out},
          {"relative_hdr", floor.relative_hdr},
          {"rmse", floor.rmse},
          {"relmse", floor.relmse},
          {"ssim", floor.ssim}};
}

Json description(const Session& session, const ReferenceImages& reference, const ErrorReport& report) {
  const View& view = session.buffer().view;
  const Provenance p = collect_provenance("", "");
  return {{"scene", session.options().scene},
          {"scene_hash", fmt::format("{:016x}", session.scene().content_hash)},
          {"view", fmt::format("{}x{}", view.width, view.height)},
          {"lighting", session.lighting_name()},
          {"light_paths", reference.settings.paths.to_string()},
          {"estimator", to_string(reference.settings.estimator)},
          {"seed", reference.settings.seed},
          {"samples_per_pixel", reference.result.samples_per_pixel},
          {"batches", reference.result.batches},
          {"rays", reference.result.rays},
          {"non_finite", reference.result.non_finite},
          {"seconds", reference.seconds},
          {"from_cache", reference.from_cache},
          {"exposure", session.scene().exposure},
          {"noise_floor", floor_json(report.noise_floor)},
          {"edge_share", report.edge_share},
          {"provenance",
           {{"commit", p.commit},
            {"compiler", p.compiler},
            {"cpu", p.cpu},
            {"threads", p.threads},
            {"date", p.date}}}};
}

void write_images(const std::filesystem::path& out, const PathTracerResult& result,
                  const std::map<std::string, std::string>& metadata) {
  write_exr(out / "direct.exr", result.direct, metadata);
  write_exr(out / "indirect.exr", result.indirect, metadata);
  write_exr(out / "total.exr", result.total(), metadata);
  write_exr(out / "variance.exr", result.indirect_variance, metadata);
}

}  // namespace

std::string run_reference(const ReferenceOptions& options) {
  const PathTracerSettings settings = settings_of(options);
  require_writable_folder("--out", options.out);
  Session session(options.session, Session::Gpu::not_needed);
  StageLog log;
  const ReferenceImages reference = reference_images(session, settings, log);
  const PathTracerResult& result = reference.result;
  const Image total = result.total();
  // The floor does not depend on the first image, so the reference stands in for it.
  const ErrorReport report =
      compare_images(total, total, result.indirect_variance, session.buffer().edge, session.scene().exposure);
  const std::filesystem::path out = options.out;
  write_images(
      out, result,
      {{"relight.scene", options.session.scene}, {"relight.light_paths", settings.paths.to_string()}});
  write_text_atomically(out / "reference.json", description(session, reference, report).dump(2) + "\n");
  if (result.non_finite > 0) fail("{} samples were not finite and were replaced by zero", result.non_finite);
  std::string text = fmt::format(
      "{}\n{} paths a pixel, {}, {} in {:.1f} s\nnoise floor: relative {:.3f} %, edges out {:.3f} %, RMSE "
      "{:.4g}\n"
      "images  {}\n",
      settings.paths.to_string(), result.samples_per_pixel, to_string(settings.estimator),
      reference.from_cache ? "loaded from the cache" : "traced", reference.seconds,
      100.0 * report.noise_floor.relative, 100.0 * report.noise_floor.relative_edges_out,
      report.noise_floor.rmse, (out / "*.exr").string());
  for (const std::string& warning : log.warnings()) text += fmt::format("warning: {}\n", warning);
  return text;
}

}  // namespace relight
