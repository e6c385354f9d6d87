#include "fake_methods.h"

#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <thread>

#include "common/run/error.h"
#include "reference/path_tracer.h"

namespace relight::test {

namespace {

using Relight = std::function<Relit(const PrepareContext&, const LightingState&, StageLog&)>;

class FakePrepared : public Prepared {
 public:
  FakePrepared(const PrepareContext& context, Relight relight)
      : context_(context), relight_(std::move(relight)) {}
  Relit relight(const LightingState& lighting, StageLog& log) override {
    return relight_(context_, lighting, log);
  }

 private:
  PrepareContext context_;
  Relight relight_;
};

class FakeMethod : public Method {
 public:
  FakeMethod(std::string name, Relight relight, bool prepare_throws = false)
      : name_(std::move(name)), relight_(std::move(relight)), prepare_throws_(prepare_throws) {}
  std::string name() const override { return name_; }
  std::string summary() const override { return "A fake."; }
  std::string paper() const override { return "None."; }
  KnobTable knobs() const override {
    return {{"size", KnobType::integer, KnobPhase::relight, "3", 1, 10, {}, "fake", "Does nothing."}};
  }
  std::vector<KnobPreset> presets() const override { return {{"big", "A larger size.", {{"size", "7"}}}}; }
  LightPaths light_paths(const KnobValues&) const override { return {}; }
  std::unique_ptr<Prepared> prepare(const PrepareContext& context) const override {
    if (prepare_throws_) fail("broken on purpose");
    return std::make_unique<FakePrepared>(context, relight_);
  }

 private:
  std::string name_;
  Relight relight_;
  bool prepare_throws_;
};

Relit traced(const PrepareContext& context, const LightingState& lighting, StageLog& log, float factor) {
  PathTracerSettings settings;
  settings.samples_per_pixel = 256;
  settings.seed = context.seed + 1000;  // other random numbers than the reference's
  Progress quiet(true);
  PathTracerResult result = path_trace(context.tracer, context.buffer, lighting, settings, quiet, log);
  for (glm::vec3& p : result.direct.pixels) p *= factor;
  for (glm::vec3& p : result.indirect.pixels) p *= factor;
  return {result.direct, result.indirect, result.total()};
}

Relit black(const PrepareContext& context, int width_change = 0) {
  const Image image(context.buffer.view.width + width_change, context.buffer.view.height);
  return {image, image, image};
}

}  // namespace

std::unique_ptr<Method> make_exact_method() {
  return std::make_unique<FakeMethod>("exact", [](const auto& context, const auto& lighting, StageLog& log) {
    return traced(context, lighting, log, 1.0f);
  });
}

std::unique_ptr<Method> make_ten_percent_method() {
  return std::make_unique<FakeMethod>("ten_percent",
                                      [](const auto& context, const auto& lighting, StageLog& log) {
                                        return traced(context, lighting, log, 1.1f);
                                      });
}

std::unique_ptr<Method> make_throwing_method(const std::string& where) {
  return std::make_unique<FakeMethod>(
      "throws_in_" + where, [](const auto&, const auto&, StageLog&) -> Relit { fail("broken on purpose"); },
      where == "precompute");
}

std::unique_ptr<Method> make_nan_method() {
  return std::make_unique<FakeMethod>("leaks_nan", [](const auto& context, const auto&, StageLog&) {
    Relit relit = black(context);
    relit.indirect.at(3, 2).y = relit.total.at(3, 2).y = std::numeric_limits<float>::quiet_NaN();
    return relit;
  });
}

std::unique_ptr<Method> make_wrong_size_method() {
  return std::make_unique<FakeMethod>(
      "wrong_size", [](const auto& context, const auto&, StageLog&) { return black(context, -1); });
}

std::unique_ptr<Method> make_listening_method(std::shared_ptr<std::vector<int64_t>> sizes) {
  return std::make_unique<FakeMethod>("listening", [sizes](const auto& context, const auto&, StageLog&) {
    sizes->push_back(context.knobs.integer("size"));
    return black(context);
  });
}

std::unique_ptr<Method> make_slow_method(bool reports_progress) {
  return std::make_unique<FakeMethod>("slow", [=](const auto& context, const auto&, StageLog& log) {
    if (reports_progress) context.progress.start("waiting", 2000);
    for (int step = 0; step < 2000; ++step) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (reports_progress)
        context.progress.advance();
      else
        StageTimer(log, "waiting");
    }
    return black(context);
  });
}

std::unique_ptr<Method> make_version(Version version) {
  // Traced once: a relight takes as long as it says, not as tracing takes on a busy machine.
  const auto kept = std::make_shared<std::optional<Relit>>();
  return std::make_unique<FakeMethod>(
      "planted", [=](const auto& context, const auto& lighting, StageLog& log) {
        StageLog unused;
        if (!*kept)
          *kept = traced(context, lighting, unused, version == Version::three_percent_dark ? 0.97f : 1.0f);
        const StageTimer timer(log, "pretend");
        std::this_thread::sleep_for(std::chrono::milliseconds(version == Version::ten_times_slower ? 30 : 3));
        log.count("pixels", static_cast<int64_t>((*kept)->total.pixels.size()));
        Relit relit = **kept;
        if (version == Version::leaks_nan)
          relit.indirect.at(3, 2).y = relit.total.at(3, 2).y = std::numeric_limits<float>::quiet_NaN();
        return relit;
      });
}

}  // namespace relight::test
