#include "reference/path_tracing_method.h"

#include "common/sampling/random.h"
#include "reference/path_tracer.h"

namespace relight {

namespace {

constexpr uint64_t method_seed_stream = 0x706174682d6d6574;

KnobTable knob_table() {
  using enum KnobType;
  using enum KnobPhase;
  return {
      {"samples",
       integer,
       relight,
       "0",
       0,
       1048576,
       {},
       "indirect",
       "Indirect paths a pixel; 0 spends time_ms instead."},
      {"time_ms",
       real,
       relight,
       "1000",
       1,
       3600000,
       {},
       "indirect",
       "Time of one relight, direct light included, in whole samples a pixel (at least one); used if samples "
       "is 0.",
       tuned_by_factor(2, 16, 60000)},
      {"bounces_max",
       integer,
       relight,
       "1",
       0,
       64,
       {},
       "indirect",
       "Largest number of bounces of indirect light; 0: direct light alone."},
      {"estimator",
       choice,
       relight,
       "next_event",
       0,
       0,
       {"next_event", "light_vertex"},
       "indirect",
       "Plain next-event estimation, or its combination with one vertex of a path from a light.",
       tuned_by_choice({"next_event", "light_vertex"})},
      {"glossy_at_eye",
       boolean,
       relight,
       "false",
       0,
       0,
       {},
       "indirect",
       "Whether visible surfaces reflect indirect light through their glossy lobe."},
      {"glossy_interior",
       boolean,
       relight,
       "false",
       0,
       0,
       {},
       "indirect",
       "Whether the surfaces behind them reflect through theirs."},
      {"environment",
       boolean,
       relight,
       "false",
       0,
       0,
       {},
       "indirect",
       "Whether light from the environment counts."},
      {"emission",
       boolean,
       relight,
       "false",
       0,
       0,
       {},
       "indirect",
       "Whether light emitted by surfaces counts."},
  };
}

LightPaths paths_of(const KnobValues& knobs) {
  LightPaths paths;
  paths.max_bounces = static_cast<int>(knobs.integer("bounces_max"));
  paths.glossy_at_eye = knobs.boolean("glossy_at_eye");
  paths.glossy_interior = knobs.boolean("glossy_interior");
  paths.environment = knobs.boolean("environment");
  paths.emission = knobs.boolean("emission");
  return paths;
}

PathTracerSettings settings_of(const KnobValues& knobs, uint64_t seed) {
  PathTracerSettings settings;
  settings.paths = paths_of(knobs);
  settings.estimator =
      knobs.choice("estimator") == "light_vertex" ? Estimator::light_vertex : Estimator::next_event;
  settings.seed = hash_combine(seed, method_seed_stream);
  settings.one_sequence = true;
  settings.area_samples = 4;  // a sub-sample: direct light must not eat the time of the rest
  const auto samples = static_cast<int>(knobs.integer("samples"));
  if (samples > 0) {
    settings.samples_per_pixel = samples;
    settings.batches = 1;
  } else {
    // One sample a pixel at a time until the time is spent.
    settings.samples_per_pixel = settings.batches = 1 << 20;
    settings.time_limit_s = 1e-3 * knobs.real("time_ms");
  }
  return settings;
}

class PathTracingPrepared : public Prepared {
 public:
  explicit PathTracingPrepared(const PrepareContext& context)
      : tracer_(context.tracer),
        buffer_(context.buffer),
        settings_(settings_of(context.knobs, context.seed)) {}

  Relit relight(const LightingState& lighting, StageLog& log) override {
    Progress quiet(true);
    quiet.set_limit(log.limit());
    PathTracerResult result = path_trace(tracer_, buffer_, lighting, settings_, quiet, log);
    log.count("samples_per_pixel", result.samples_per_pixel);
    Relit relit;
    relit.total = result.total();
    relit.direct = std::move(result.direct);
    relit.indirect = std::move(result.indirect);
    return relit;
  }

 private:
  const RayTracer& tracer_;
  const DeepFrameBuffer& buffer_;
  PathTracerSettings settings_;
};

class PathTracing : public Method {
 public:
  std::string name() const override { return "path_tracing"; }
  std::string summary() const override {
    return "Path tracing on the CPU under a time or sample budget, with exact direct light; no precompute.";
  }
  std::string paper() const override { return "James T. Kajiya: The Rendering Equation, SIGGRAPH 1986"; }
  KnobTable knobs() const override { return knob_table(); }
  LightPaths light_paths(const KnobValues& knobs) const override { return paths_of(knobs); }
  bool repeatable(const KnobValues& knobs) const override { return knobs.integer("samples") > 0; }
  std::vector<Effect> effects(const KnobValues&) const override {
    return {bounces_effect("bounces_max", 8),
            boolean("glossy_at_eye", "Indirect light in glossy reflections at the visible surface."),
            boolean("glossy_interior", "Light that surfaces behind the visible one reflect glossily."),
            boolean("environment", "Light from the environment."),
            boolean("emission", "Light emitted by surfaces.")};
  }
  std::unique_ptr<Prepared> prepare(const PrepareContext& context) const override {
    return std::make_unique<PathTracingPrepared>(context);
  }

 private:
  static Effect boolean(const std::string& name, const std::string& sentence) {
    return switch_effect(name, sentence, name, "false", "true");
  }
};

}  // namespace

std::unique_ptr<Method> make_path_tracing() { return std::make_unique<PathTracing>(); }

}  // namespace relight
