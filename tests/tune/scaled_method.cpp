#include "scaled_method.h"

#include "reference/path_tracer.h"

namespace relight::test {

namespace {

class ScaledPrepared : public Prepared {
 public:
  ScaledPrepared(const PrepareContext& context, bool overfit, int& relights)
      : tracer_(context.tracer),
        buffer_(context.buffer),
        seed_(context.seed),
        overfit_(overfit),
        relights_(relights) {
    quality_ = static_cast<double>(context.knobs.integer("quality"));
    detail_ = static_cast<double>(context.knobs.integer("detail"));
  }
  Relit relight(const LightingState& lighting, StageLog& log) override {
    ++relights_;
    PathTracerSettings settings;
    settings.samples_per_pixel = 256;
    settings.seed = seed_;
    Progress quiet(true);
    const PathTracerResult exact = path_trace(tracer_, buffer_, lighting, settings, quiet, log);
    const double error = scaled_error(quality_, detail_) + (overfit_ && lighting.name != "omni" ? 0.5 : 0.0);
    Image direct = exact.direct, indirect = exact.indirect;
    for (Image* image : {&direct, &indirect})
      for (glm::vec3& p : image->pixels) p *= static_cast<float>(1.0 + error);
    log.bytes("planted", static_cast<int64_t>(1e6 * (quality_ + 3.0 * detail_)));
    return with_total(std::move(direct), std::move(indirect));
  }

 private:
  const RayTracer& tracer_;
  const DeepFrameBuffer& buffer_;
  uint64_t seed_;
  bool overfit_;
  int& relights_;
  double quality_, detail_;
};

class ScaledMethod : public Method {
 public:
  ScaledMethod(bool overfit, int& relights) : overfit_(overfit), relights_(relights) {}
  std::string name() const override { return "scaled"; }
  std::string summary() const override { return "A fake."; }
  std::string paper() const override { return "None."; }
  KnobTable knobs() const override {
    return {{"quality",
             KnobType::integer,
             KnobPhase::precompute,
             "8",
             1,
             64,
             {},
             "fake",
             "Quality.",
             tuned_by_factor(2, 1, 64)},
            {"detail",
             KnobType::integer,
             KnobPhase::relight,
             "8",
             1,
             64,
             {},
             "fake",
             "Detail.",
             tuned_by_factor(2, 1, 64)}};
  }
  std::vector<KnobPreset> presets() const override {
    return {{"fine", "Finer.", {{"quality", "64"}, {"detail", "64"}}}};
  }
  LightPaths light_paths(const KnobValues&) const override { return {}; }
  std::unique_ptr<Prepared> prepare(const PrepareContext& context) const override {
    return std::make_unique<ScaledPrepared>(context, overfit_, relights_);
  }

 private:
  bool overfit_;
  int& relights_;
};

}  // namespace

std::unique_ptr<Method> make_scaled_method(int& relights, bool overfit) {
  return std::make_unique<ScaledMethod>(overfit, relights);
}

}  // namespace relight::test
