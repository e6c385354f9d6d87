#include "reference/path_tracer.h"

#include <algorithm>
#include <chrono>

#include "common/run/error.h"
#include "reference/batch_renderer.h"
#include "reference/path_pattern.h"
#include "reference/path_tracer_images.h"

namespace relight {

namespace {

// A sixteenth of the samples at most, and enough: a tile has 16 pixels.
constexpr int planning_samples = 8, least_samples_for_planning = 128;

void check(const PathTracerSettings& settings, const DeepFrameBuffer& buffer) {
  const int least = settings.one_sequence ? 1 : 2;
  if (settings.batches < least)
    fail("path tracer: batches = {}; it must be at least {}", settings.batches, least);
  if (settings.samples_per_pixel < settings.batches)
    fail("path tracer: samples_per_pixel = {}; it must be at least the number of batches ({})",
         settings.samples_per_pixel, settings.batches);
  if (!settings.pattern.empty() && settings.class_bounces < 0)
    fail("path tracer: a pattern of light paths needs class_bounces >= 0");
  if (!(settings.target_error >= 0.0))
    fail("path tracer: target_error = {}; it must be >= 0 (0: none)", settings.target_error);
  const LightPaths& paths = settings.paths;
  const bool none = paths.min_bounces == 1 && paths.max_bounces == 0;
  if (!none && (paths.min_bounces < 0 || paths.max_bounces < paths.min_bounces))
    fail("path tracer: bounces {}..{}; needed are 0 <= min <= max, or 1..0 for direct light alone",
         paths.min_bounces, paths.max_bounces);
  if (settings.area_samples < 2 || settings.area_samples % 2 != 0)
    fail("path tracer: area_samples = {}; it must be even and at least 2", settings.area_samples);
  if (!(settings.time_limit_s >= 0.0))
    fail("path tracer: time_limit_s = {}; it must be >= 0 (0: no limit)", settings.time_limit_s);
  const size_t pixels = static_cast<size_t>(buffer.view.width) * static_cast<size_t>(buffer.view.height);
  if (buffer.indirect.size() != pixels || buffer.direct.size() != 4 * pixels)
    fail("path tracer: the deep frame buffer does not hold {}x{} pixels", buffer.view.width,
         buffer.view.height);
}

bool any_glossy(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return m.is_glossy(); });
}

PathClasses path_classes(const Scene& scene, const Environment& environment,
                         const PathTracerSettings& settings, const AreaLights& area) {
  if (settings.class_bounces < 0) return {};
  return PathClasses(settings.class_bounces, settings.paths, any_glossy(scene), !area.empty(),
                     settings.paths.environment && !environment.black());
}

// Restricts classes and direct light to the pattern.
void apply_pattern(const std::string& pattern, PathClasses& classes, DirectImage& direct) {
  if (pattern.empty()) return;
  std::vector<PathClass> all = DirectImage::classes();
  if (direct.has_area())
    for (const PathClass& c : DirectImage::area_classes()) all.push_back(c);
  if (direct.has_environment())
    for (const PathClass& c : DirectImage::environment_classes()) all.push_back(c);
  const size_t exact = all.size();
  all.insert(all.end(), classes.classes().begin(), classes.classes().end());
  std::vector<uint8_t> chosen(all.size(), 0);
  const std::vector<size_t> selected = select_paths(pattern, all);
  if (selected.empty())
    fail("light paths: '{}' selects no path that this scene and these bounces have", pattern);
  for (const size_t i : selected) chosen[i] = 1;
  std::vector<Image*> images = {&direct.local_diffuse, &direct.local_glossy, &direct.seen_area,
                                &direct.seen_environment};
  if (direct.has_area()) images.insert(images.end(), {&direct.area_diffuse, &direct.area_glossy});
  if (direct.has_environment())
    images.insert(images.end(), {&direct.environment_diffuse, &direct.environment_glossy});
  for (size_t i = 0; i < exact; ++i)
    if (!chosen[i]) *images[i] = Image(images[i]->width, images[i]->height);
  classes.select({chosen.begin() + static_cast<std::ptrdiff_t>(exact), chosen.end()});
}

// Renders batches until one of the settings says stop.
class Run {
 public:
  Run(const PathTracerSettings& settings, const Image& direct, BatchRenderer& renderer, double direct_seconds)
      : settings_(settings), direct_(direct), renderer_(renderer) {
    if (!settings.checkpoint.file.empty()) {
      if (auto state = load_state(settings.checkpoint.file, settings.checkpoint.key)) {
        if (!renderer.fits(*state))
          fail(
              "checkpoint '{}' belongs to a picture of another size or with other path classes; delete it or "
              "choose another folder",
              settings.checkpoint.file.string());
        renderer.resume(std::move(*state));
        resumed_ = true;
      }
    }
    before_ = resumed_ ? renderer.state().seconds : direct_seconds;
  }

  bool resumed() const { return resumed_; }
  double seconds() const { return before_ + elapsed(); }
  // The state with the time spent on it.
  PathTracerState state() const {
    PathTracerState s = renderer_.state();
    s.seconds = seconds();
    return s;
  }

  void render(int per_batch, Progress& progress) {
    double longest = 0.0, saved = elapsed();
    while (renderer_.state().batches < settings_.batches && !finished(longest)) {
      const double start = elapsed();
      renderer_.render(progress);
      longest = std::max(longest, elapsed() - start);
      if (settings_.on_batch) settings_.on_batch({seconds(), renderer_.state().batches * per_batch, error()});
      if (elapsed() - saved >= settings_.checkpoint.every_s) {
        save();
        saved = elapsed();
      }
    }
    save();
  }

  double error() const {
    return settings_.one_sequence ? 0.0 : relative_standard_error(renderer_.state(), direct_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  bool finished(double longest) const {
    const int batches = renderer_.state().batches;
    if (settings_.target_error > 0.0 && batches >= 4 && error() <= settings_.target_error) return true;
    const bool too_late = settings_.time_limit_s > 0.0 && seconds() + longest > settings_.time_limit_s;
    return batches >= (settings_.one_sequence ? 1 : 2) && too_late;
  }
  void save() const {
    if (!settings_.checkpoint.file.empty())
      save_state(settings_.checkpoint.file, settings_.checkpoint.key, state());
  }

  const PathTracerSettings& settings_;
  const Image& direct_;
  BatchRenderer& renderer_;
  Clock::time_point start_ = Clock::now();
  double before_ = 0.0;
  bool resumed_ = false;
};

void report(const PathTracerResult& result, StageLog& log) {
  log.count("rays", result.rays);
  log.count("non_finite_samples", result.non_finite);
  log.count("firefly_pixels", result.fireflies);
  if (result.non_finite > 0)
    log.warn(fmt::format("{} non-finite path samples were replaced by zero", result.non_finite));
  if (result.fireflies > 0)
    log.warn(
        fmt::format("{} pixels are dominated by one bright batch: their value and variance are not to be "
                    "trusted; more samples help",
                    result.fireflies));
}

}  // namespace

PathTracerResult path_trace(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                            const LightingState& lighting, const PathTracerSettings& settings,
                            Progress& progress, StageLog& log) {
  const auto start = std::chrono::steady_clock::now();
  check(settings, buffer);
  const Scene& scene = tracer.scene();
  const LightSampler lights(lighting, scene.bounds.diagonal());
  const AreaLights area(scene, lighting, settings.paths.emission, tracer.offset());
  const Environment& light_from_afar = lighting.environment_or(scene.environment);
  const EnvironmentSampler environment(light_from_afar);
  PathClasses classes = path_classes(scene, light_from_afar, settings, area);
  PathTracerResult result;
  DirectImage direct;
  {
    StageTimer timer(log, "direct");
    // With 0 bounces they are sampled with the rest.
    const bool apart = settings.paths.min_bounces >= 1;
    const bool environment_apart = apart && settings.paths.environment && !light_from_afar.black();
    direct = trace_direct(tracer, buffer, lights, light_from_afar, settings.paths,
                          {apart && area.has_shapes() ? &area : nullptr,
                           environment_apart ? &environment : nullptr, settings.area_samples, settings.seed});
    apply_pattern(settings.pattern, classes, direct);
    result.direct = direct.total();
  }

  StageTimer timer(log, "indirect");
  const int per_batch = (settings.samples_per_pixel + settings.batches - 1) / settings.batches;
  const PathSampler sampler(tracer, lights, area, environment, classes, settings);
  BatchRenderer renderer(sampler, tracer, buffer, settings, per_batch);
  Run run(settings, result.direct, renderer,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  progress.start("path tracing",
                 int64_t{std::max(0, settings.batches - renderer.state().batches)} * renderer.tasks());
  const bool adaptive = settings.estimator == Estimator::light_vertex && !settings.one_sequence;
  if (!run.resumed() && adaptive && settings.samples_per_pixel >= least_samples_for_planning)
    renderer.plan(planning_samples);
  run.render(per_batch, progress);
  progress.finish();

  const PathTracerState& state = renderer.state();
  result.batches = state.batches;
  result.samples_per_pixel = state.batches * per_batch;
  result.rays = state.rays + direct.rays;
  result.non_finite = state.non_finite + direct.non_finite;
  result.seconds = run.seconds();
  result.relative_standard_error = run.error();
  // Batches of one sequence aren't independent: their spread says nothing about the error.
  write_indirect(state, !settings.one_sequence && state.batches >= 2, result);
  for (size_t i = 0; direct.has_area() && i < result.indirect_variance.pixels.size(); ++i)
    result.indirect_variance.pixels[i] += direct.area_variance.pixels[i];
  for (size_t i = 0; direct.has_environment() && i < result.indirect_variance.pixels.size(); ++i)
    result.indirect_variance.pixels[i] += direct.environment_variance.pixels[i];
  if (classes.told_apart()) write_layers(state, classes, direct, result);
  report(result, log);
  return result;
}

}  // namespace relight
