#include "experiments/reference_run/reference_run.h"

#include <cmath>

#include "common/image/exr.h"
#include "common/image/metrics.h"
#include "common/run/atomic_file.h"
#include "experiments/compare/reference_images.h"
#include "experiments/options/parse.h"
#include "experiments/reference_run/convergence_file.h"
#include "experiments/reference_run/reference_description.h"
#include "experiments/session/output_folder.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

void check(const ReferenceOptions& options) {
  if (options.glossy != "none" && options.glossy != "eye" && options.glossy != "all")
    usage_fail("--glossy '{}': valid: none, eye, all", options.glossy);
  if (!(options.time_limit_s >= 0.0) || std::isinf(options.time_limit_s))
    usage_fail("--time {}: expected a number of seconds, 0 for no limit", options.time_limit_s);
  if (!(options.target_percent >= 0.0) || std::isinf(options.target_percent))
    usage_fail("--target-error {}: expected per cent >= 0, 0 for none", options.target_percent);
  if (!(options.checkpoint_s >= 0.0) || std::isinf(options.checkpoint_s))
    usage_fail("--checkpoint-seconds {}: expected a number of seconds, 0 for after every batch",
               options.checkpoint_s);
  if (options.batch < 1 || options.batch > 65536)
    usage_fail("--batch {}: expected 1 to 65536 samples", options.batch);
  if (options.class_bounces < 0 || options.class_bounces > 12)
    usage_fail("--class-bounces {}: expected 0 to 12", options.class_bounces);
  require_samples("--samples", options.samples);
}

PathTracerSettings settings_of(const ReferenceOptions& options) {
  check(options);
  const BounceRange bounces = parse_bounces(options.bounces, 0);
  PathTracerSettings settings;
  settings.paths.min_bounces = bounces.min;
  settings.paths.max_bounces = bounces.max;
  settings.paths.glossy_at_eye = options.glossy != "none";
  settings.paths.glossy_interior = options.glossy == "all";
  settings.paths.emission = settings.paths.environment = true;
  settings.pattern = options.paths;
  if (options.layers || !options.paths.empty()) settings.class_bounces = options.class_bounces;
  settings.batches = std::max(2, (options.samples + options.batch - 1) / options.batch);
  settings.samples_per_pixel = settings.batches * options.batch;
  settings.estimator = parse_estimator(options.estimator);
  settings.seed = options.session.seed;
  settings.time_limit_s = options.time_limit_s;
  settings.target_error = 0.01 * options.target_percent;
  return settings;
}

void write_layers(const std::filesystem::path& out, const PathTracerResult& result) {
  std::vector<NamedImage> means, variances;
  for (const PathLayer& layer : result.layers) {
    means.push_back({layer.path_class.name(), &layer.mean});
    variances.push_back({layer.path_class.name(), &layer.variance});
  }
  write_exr_layers(out / "layers.exr", means);
  write_exr_layers(out / "layers_variance.exr", variances);
}

void write_images(const std::filesystem::path& out, const PathTracerResult& result,
                  const std::map<std::string, std::string>& metadata) {
  write_exr(out / "direct.exr", result.direct, metadata);
  write_exr(out / "indirect.exr", result.indirect, metadata);
  write_exr(out / "total.exr", result.total(), metadata);
  write_exr(out / "variance.exr", result.indirect_variance, metadata);
}

std::string summary(const PathTracerResult& result, const PathTracerSettings& settings,
                    const ErrorReport& report) {
  return fmt::format(
      "{}{}\n{} paths a pixel in {} batches, {}, traced in {:.1f} s\nrelative standard error {:.3f} %, {} "
      "pixels "
      "dominated by one batch\nnoise floor: relative {:.3f} %, edges out {:.3f} %, RMSE {:.4g}\n",
      settings.paths.to_string(), settings.pattern.empty() ? "" : ", of these " + settings.pattern,
      result.samples_per_pixel, result.batches, to_string(settings.estimator), result.seconds,
      100.0 * result.relative_standard_error, result.fireflies, 100.0 * report.noise_floor.relative,
      100.0 * report.noise_floor.relative_edges_out, report.noise_floor.rmse);
}

}  // namespace

std::string run_reference(const ReferenceOptions& options) {
  PathTracerSettings settings = settings_of(options);
  require_writable_folder("--out", options.out);
  const std::filesystem::path out = options.out;
  Session session(options.session, Session::Gpu::not_needed);
  settings.checkpoint = {out / "state.relight",
                         fmt::format("{} batch={}", picture_key(session, settings), options.batch),
                         options.checkpoint_s};
  if (options.restart) std::filesystem::remove(settings.checkpoint.file);
  ConvergenceFile convergence(out / "convergence.csv", std::filesystem::exists(settings.checkpoint.file));
  settings.on_batch = [&](const ConvergencePoint& point) { convergence.add(point); };

  StageLog log;
  const PathTracerResult result =
      path_trace(session.tracer(), session.buffer(), session.lighting(), settings, session.progress(), log);
  const Image total = result.total();
  // The floor does not depend on the first image, so the reference stands in for it.
  const ErrorReport report =
      compare_images(total, total, result.indirect_variance, session.buffer().edge, session.scene().exposure);
  write_images(out, result,
               {{"relight.scene", options.session.scene},
                {"relight.light_paths", settings.paths.to_string()},
                {"relight.pattern", settings.pattern}});
  if (options.layers) write_layers(out, result);
  write_text_atomically(out / "reference.json",
                        describe_reference(session, settings, result, report).dump(2) + "\n");
  if (result.non_finite > 0) fail("{} samples were not finite and were replaced by zero", result.non_finite);
  std::string text = summary(result, settings, report);
  text += fmt::format("images  {}\n", (out / "*.exr").string());
  for (const std::string& warning : log.warnings()) text += fmt::format("warning: {}\n", warning);
  return text;
}

}  // namespace relight
