// Each path class against an independent render that LightPaths and the lights alone restrict to it.
#include "reference/path_pattern.h"
#include "tests/reference/class_scene.h"

namespace relight::tiny {
namespace {

constexpr int class_bounces = 2, most_bounces = 4, seeds = 16;

// Mean and standard error over seeds.
struct Statistic {
  double mean = 0.0, squares = 0.0;
  int count = 0;
  void add(double value) {
    const double before = value - mean;
    mean += before / ++count;
    squares += before * (value - mean);
  }
  double variance() const { return squares / (count * (count - 1.0)); }
};

double brightness(const Image& image) {
  const glm::dvec3 m = mean_of(image);
  return (m.x + m.y + m.z) / 3.0;
}

// A render with these restrictions holds the classes of `pattern` (0 bounces of local light are the direct
// image).
struct Restriction {
  const char* name;
  const char* pattern;
  int min, max;
  bool glossy_at_eye, glossy_interior;
  LightEnd end;
};
void PrintTo(const Restriction& r, std::ostream* out) { *out << r.name; }

// Many seeds of the picture with all classes, kept for all cases.
class Restricted : public testing::TestWithParam<Restriction> {
 protected:
  static const Rendering& render() {
    static const Rendering rendering(full_scene(), 8, 6);
    return rendering;
  }
  static const std::vector<std::vector<PathLayer>>& split() {
    static const std::vector<std::vector<PathLayer>> runs = [] {
      std::vector<std::vector<PathLayer>> made;
      for (uint64_t seed = 0; seed < seeds; ++seed) {
        PathTracerSettings s = settings(Estimator::light_vertex, 256, 2, all_paths(0, most_bounces), seed);
        s.class_bounces = class_bounces;
        made.push_back(render()(local, s).layers);
      }
      return made;
    }();
    return runs;
  }
};

INSTANTIATE_TEST_SUITE_P(
    Classes, Restricted,
    testing::Values(
        Restriction{"local_diffuse", "E D D Lp", 1, 1, false, false, LightEnd::local},
        Restriction{"local_glossy_eye", "E . D Lp", 1, 1, true, false, LightEnd::local},
        Restriction{"local_glossy_interior", "E D . Lp", 1, 1, false, true, LightEnd::local},
        Restriction{"local_two_bounces", "E D D D Lp", 2, 2, false, false, LightEnd::local},
        Restriction{"local_two_bounces_all", "E . . . Lp", 2, 2, true, true, LightEnd::local},
        Restriction{"local_longer", "E D .{3,} Lp", 3, most_bounces, false, true, LightEnd::local},
        Restriction{"area_direct_diffuse", "E D La", 0, 0, false, false, LightEnd::area},
        Restriction{"area_direct", "E . La", 0, 0, true, false, LightEnd::area},
        Restriction{"area_diffuse", "E D D La", 1, 1, false, false, LightEnd::area},
        Restriction{"area_glossy_interior", "E D . La", 1, 1, false, true, LightEnd::area},
        Restriction{"area_glossy_eye", "E . D D La", 2, 2, true, false, LightEnd::area},
        Restriction{"area_longer", "E . .{3,} La", 3, most_bounces, true, true, LightEnd::area},
        Restriction{"sky_direct_diffuse", "E D Le", 0, 0, false, false, LightEnd::environment},
        Restriction{"sky_direct", "E . Le", 0, 0, true, false, LightEnd::environment},
        Restriction{"sky_diffuse", "E D D Le", 1, 1, false, false, LightEnd::environment},
        Restriction{"sky_glossy_eye", "E . D Le", 1, 1, true, false, LightEnd::environment},
        Restriction{"sky_glossy_interior", "E D .{2} Le", 2, 2, false, true, LightEnd::environment},
        Restriction{"sky_longer", "E D D{3,} Le", 3, most_bounces, false, false, LightEnd::environment}),
    [](const auto& test) { return std::string(test.param.name); });

// 6 standard errors of 2 x 16 seeds (30 degrees of freedom): a false alarm in 7e5 for each case. Red if (each
// tried): a bounce is counted to its neighbour, the lobes of the first vertex or of later ones are swapped,
// an end takes the light of another, or the glossy part of a connection counts as diffuse.
TEST_P(Restricted, RenderGivesTheSameLight) {
  const Restriction& r = GetParam();
  Statistic layers, alone;
  for (const std::vector<PathLayer>& run : split()) {
    std::vector<PathClass> classes;
    for (const PathLayer& layer : run) classes.push_back(layer.path_class);
    double sum = 0.0;
    for (const size_t i : select_paths(r.pattern, classes)) sum += brightness(run[i].mean);
    layers.add(sum);
  }
  LightPaths paths = bounces(r.min, r.max);
  paths.glossy_at_eye = r.glossy_at_eye, paths.glossy_interior = r.glossy_interior;
  paths.emission = r.end == LightEnd::area, paths.environment = r.end == LightEnd::environment;
  const LightingState lights = r.end == LightEnd::local ? local : LightingState{};
  for (uint64_t seed = 0; seed < seeds; ++seed)
    alone.add(
        brightness(render()(lights, settings(Estimator::next_event, 256, 2, paths, 1000 + seed)).indirect));
  const double error = std::sqrt(layers.variance() + alone.variance());
  EXPECT_LT(std::abs(layers.mean - alone.mean), 6.0 * error) << layers.mean << " against " << alone.mean;
  EXPECT_LT(6.0 * error, 0.15 * alone.mean) << "too noisy to tell";
}

// Pixel by pixel, with the variance that layers state. Red if (both tried): a layer's variance is that of
// the whole picture, or of a batch instead of the mean.
TEST(PathLayers, StateTheirOwnVariance) {
  const Rendering render(full_scene(), 8, 6);
  PathTracerSettings s = settings(Estimator::next_event, 64 * 64, 64, all_paths(1, 2));
  s.class_bounces = 2;
  const PathTracerResult split = render(local, s);
  const PathTracerResult one = render(local, settings(Estimator::next_event, 64 * 64, 64, bounces(1, 1), 5));
  for (const PathLayer& layer : split.layers)
    if (layer.path_class.name() == "b1.D.D.local") {
      const ZTest z(layer.mean, layer.variance, one.indirect, one.indirect_variance);
      expect_same_mean(z);
      EXPECT_GT(z.mean_square, 0.65);
      return;
    }
  FAIL() << "no layer of one diffuse bounce";
}

}  // namespace
}  // namespace relight::tiny
