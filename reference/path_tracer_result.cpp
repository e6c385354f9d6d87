#include <cmath>

#include "reference/path_tracer.h"
#include "reference/path_tracer_images.h"

namespace relight {

Image PathTracerResult::total() const {
  Image sum = direct;
  for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += indirect.pixels[i];
  return sum;
}

namespace {

// Statistics of class c of `count`, pixel by pixel.
PathLayer sampled_layer(const PathTracerState& state, const PathClasses& classes, size_t c,
                        const Image& size) {
  PathLayer layer{classes.classes()[c], Image(size.width, size.height), Image(size.width, size.height)};
  for (size_t i = 0; i < state.pixels.size(); ++i) {
    const PixelStatistics& s = state.layers[i * classes.count() + c];
    layer.mean.pixels[i] = glm::vec3(s.mean);
    if (state.batches >= 2) layer.variance.pixels[i] = glm::vec3(s.variance(state.batches));
  }
  return layer;
}

bool is_black(const Image& image) {
  for (const glm::vec3& p : image.pixels)
    if (p != glm::vec3(0.0f)) return false;
  return true;
}

}  // namespace

double relative_standard_error(const PathTracerState& state, const Image& direct) {
  if (state.batches < 2) return 0.0;
  double error = 0.0, sum = 0.0;
  for (size_t i = 0; i < state.pixels.size(); ++i) {
    const PixelStatistics& s = state.pixels[i];
    const glm::dvec3 v = s.variance(state.batches), m = s.mean + glm::dvec3(direct.pixels[i]);
    error += v.x + v.y + v.z;
    sum += glm::dot(m, m);
  }
  return sum > 0.0 ? std::sqrt(error / sum) : 0.0;
}

void write_indirect(const PathTracerState& state, bool with_variance, PathTracerResult& result) {
  const int width = result.direct.width, height = result.direct.height;
  result.indirect = Image(width, height);
  if (with_variance) result.indirect_variance = Image(width, height);
  for (size_t i = 0; i < state.pixels.size(); ++i) {
    const PixelStatistics& s = state.pixels[i];
    result.indirect.pixels[i] = glm::vec3(s.mean);
    if (with_variance) result.indirect_variance.pixels[i] = glm::vec3(s.variance(state.batches));
    // Batches of one sequence are single samples: any of them may dominate.
    if (with_variance) result.fireflies += s.is_firefly(state.batches);
  }
}

void write_layers(const PathTracerState& state, const PathClasses& classes, const DirectImage& direct,
                  PathTracerResult& result) {
  const Image zero(result.direct.width, result.direct.height);
  const Image* exact[] = {&direct.local_diffuse, &direct.local_glossy, &direct.seen_area,
                          &direct.seen_environment};
  const std::vector<PathClass> exact_classes = DirectImage::classes();
  for (size_t i = 0; i < exact_classes.size(); ++i)
    if (!is_black(*exact[i])) result.layers.push_back({exact_classes[i], *exact[i], zero});
  if (direct.has_area()) {
    const std::vector<PathClass> area_classes = DirectImage::area_classes();
    result.layers.push_back({area_classes[0], direct.area_diffuse, direct.area_variance});
    if (!is_black(direct.area_glossy)) result.layers.push_back({area_classes[1], direct.area_glossy, zero});
  }
  // Black where a pattern leaves them out.
  const std::vector<PathClass> environment_classes = DirectImage::environment_classes();
  if (direct.has_environment() && !is_black(direct.environment_diffuse))
    result.layers.push_back(
        {environment_classes[0], direct.environment_diffuse, direct.environment_variance});
  if (direct.has_environment() && !is_black(direct.environment_glossy))
    result.layers.push_back({environment_classes[1], direct.environment_glossy, zero});
  for (size_t c = 0; c < classes.classes().size(); ++c)
    result.layers.push_back(sampled_layer(state, classes, c, zero));
}

}  // namespace relight
