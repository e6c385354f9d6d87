#include "experiments/effects/pilot.h"

#include <algorithm>
#include <cmath>

#include "common/sampling/random.h"
#include "reference/path_tracer.h"

namespace relight {

namespace {

constexpr uint64_t replicate_stream = 0x65666665637470;

}  // namespace

Pilot::Pilot(const EffectSite& site, const LightPaths& paths, int told_apart, int samples_a_replicate,
             uint64_t seed, EffectPaths& groups, Progress& progress)
    : site_(site),
      paths_(paths),
      told_apart_(told_apart),
      samples_(samples_a_replicate),
      seed_(seed),
      groups_(groups),
      progress_(progress) {
  light_.width = site.buffer.view.width, light_.height = site.buffer.view.height;
}

void Pilot::trace(int replicates) {
  while (static_cast<int>(light_.replicates.size()) < replicates) add_replicate();
}

void Pilot::add_replicate() {
  PathTracerSettings settings;
  settings.paths = paths_;
  settings.samples_per_pixel = samples_;
  settings.batches = 1;
  settings.one_sequence = true;  // the spread of replicates tells the noise
  settings.class_bounces = told_apart_;
  settings.seed = random_bits(seed_, replicate_stream, light_.replicates.size(), 0);
  StageLog log;
  const PathTracerResult result =
      path_trace(site_.tracer, site_.buffer, site_.lighting, settings, progress_, log);
  light_.samples += result.samples_per_pixel;
  light_.rays += result.rays;
  light_.non_finite += result.non_finite;
  std::vector<Image>& images = light_.replicates.emplace_back();
  for (const PathLayer& layer : result.layers) {
    const size_t group = groups_.group_of(layer.path_class);
    while (images.size() <= group) images.emplace_back(light_.width, light_.height);
    for (size_t i = 0; i < layer.mean.pixels.size(); ++i) images[group].pixels[i] += layer.mean.pixels[i];
  }
}

View smaller_view(const View& view, int pixels) {
  const double shrink = std::sqrt(static_cast<double>(pixels) /
                                  (static_cast<double>(view.width) * static_cast<double>(view.height)));
  if (shrink >= 1.0) return view;
  const auto side = [&](int full) { return std::max(1, static_cast<int>(std::floor(full * shrink))); };
  return {view.camera, side(view.width), side(view.height)};
}

}  // namespace relight
