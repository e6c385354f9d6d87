// Path classes: nothing is lost between them, and each holds its own paths.
#include <set>

#include "common/run/error.h"
#include "reference/direct_image.h"
#include "reference/path_pattern.h"
#include "reference/path_vertex.h"
#include "tests/reference/class_scene.h"

namespace relight::tiny {
namespace {

Image sum_of(const std::vector<PathLayer>& layers, const std::vector<size_t>& which) {
  Image sum(layers[0].mean.width, layers[0].mean.height);
  for (const size_t i : which)
    for (size_t p = 0; p < sum.pixels.size(); ++p) sum.pixels[p] += layers[i].mean.pixels[p];
  return sum;
}

std::vector<size_t> everything(const std::vector<PathLayer>& layers) {
  std::vector<size_t> all(layers.size());
  for (size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

std::vector<PathClass> classes_of(const std::vector<PathLayer>& layers) {
  std::vector<PathClass> classes;
  for (const PathLayer& layer : layers) classes.push_back(layer.path_class);
  return classes;
}

// Equal but for the order of float sums.
void expect_same_picture(const Image& a, const Image& b) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(a.pixels[i][c], b.pixels[i][c], 1e-5f * (0.1f + b.pixels[i][c])) << i;
}

// Against all 2^4 words of lobes written out. Red if (each tried): a lobe is lost after a glossy interior
// vertex, the eye's lobe counts as interior, or a survivor of Russian roulette loses a class.
TEST(Throughput, HoldsEveryWordOfLobesInItsClass) {
  const Reflected f[4] = {{{0.2f, 0.3f, 0.4f}, {0.5f, 0.1f, 0.0f}},
                          {{0.7f, 0.6f, 0.5f}, {0.3f, 0.2f, 0.1f}},
                          {{0.1f, 0.9f, 0.4f}, {0.8f, 0.3f, 0.6f}},
                          {{0.4f, 0.2f, 0.3f}, {0.9f, 0.7f, 0.5f}}};
  for (int vertices = 1; vertices <= 4; ++vertices) {
    glm::vec3 expected[2][2] = {};
    for (int word = 0; word < (1 << vertices); ++word) {
      glm::vec3 product(1.0f);
      for (int v = 0; v < vertices; ++v) product *= (word >> v) & 1 ? f[v].glossy : f[v].diffuse;
      expected[word & 1][(word >> 1) != 0] += product;
    }
    Throughput before_last, after;
    for (int v = 0; v + 1 < vertices; ++v) before_last.advance(f[v]);
    for (int v = 0; v < vertices; ++v) after.advance(f[v]);
    after.scale(0.5f);
    const SplitRadiance reflected = before_last.reflect(f[vertices - 1]),
                        emitted = after.emitted(glm::vec3(2.0f));
    for (int eye = 0; eye < 2; ++eye)
      for (int interior = 0; interior < 2; ++interior)
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(reflected.value[eye][interior][c], expected[eye][interior][c], 1e-6f);
          EXPECT_NEAR(emitted.value[eye][interior][c], expected[eye][interior][c], 1e-6f);
        }
  }
}

// Red if (each tried): light is left out of its class (connections at the eye), counted in two, or one
// lobe of a vertex is lost; a class is missing for paths between the counted bounces and the least.
TEST(PathClasses, AddUpToThePicture) {
  const Rendering render(full_scene(), 12, 9);
  struct Case {
    int min, max, class_bounces;
  };
  for (const Estimator estimator : {Estimator::next_event, Estimator::light_vertex})
    for (const Case c :
         {Case{0, 4, 0}, Case{0, 4, 2}, Case{1, 3, 5}, Case{3, 5, 1}, Case{0, 0, 2}, Case{2, 2, 1}}) {
      SCOPED_TRACE(testing::Message() << c.min << ".." << c.max << ", classes up to " << c.class_bounces);
      PathTracerSettings s = settings(estimator, 16, 4, all_paths(c.min, c.max));
      const PathTracerResult plain = render(local, s);
      s.class_bounces = c.class_bounces;
      const PathTracerResult split = render(local, s);
      ASSERT_FALSE(split.layers.empty());
      expect_same_picture(sum_of(split.layers, everything(split.layers)), split.total());
      expect_same_picture(split.total(), plain.total());
    }
}

// Red if (tried): classes() is empty where nothing is sampled and the exact layers go with it.
TEST(PathClasses, KeepTheExactLayersWhereNothingElseIsSampled) {
  const Rendering render(room(), 8, 6);
  PathTracerSettings s = settings(Estimator::next_event, 4, 2, bounces(0, 0));
  s.class_bounces = 1;
  const PathTracerResult result = render(local, s);
  ASSERT_EQ(result.layers.size(), 1u);
  EXPECT_EQ(result.layers[0].path_class.name(), "b0.D.local");
  expect_same_picture(result.layers[0].mean, result.total());
}

// Red if (tried): longer paths are left out of the class "or more".
TEST(PathClasses, OpenClassIsTheSumOfFinerOnes) {
  const Rendering render(full_scene(), 8, 6);
  PathTracerSettings s = settings(Estimator::light_vertex, 32, 4, all_paths(0, 6));
  s.class_bounces = 1;
  const std::vector<PathLayer> coarse = render(local, s).layers;
  s.class_bounces = 6;
  const std::vector<PathLayer> fine = render(local, s).layers;
  int open = 0;
  for (size_t i = 0; i < coarse.size(); ++i) {
    const PathClass& c = coarse[i].path_class;
    std::vector<size_t> parts;
    for (size_t f = 0; f < fine.size(); ++f) {
      PathClass p = fine[f].path_class;
      EXPECT_FALSE(p.or_more);
      const bool counts = c.or_more ? p.bounces >= c.bounces : p.bounces == c.bounces;
      p.bounces = c.bounces, p.or_more = c.or_more;
      if (counts && p == c) parts.push_back(f);
    }
    open += c.or_more;
    SCOPED_TRACE(c.name());
    expect_same_picture(coarse[i].mean, sum_of(fine, parts));
  }
  EXPECT_EQ(open, 12) << "three ends, two lobes at the eye, two kinds of interior";
}

// Red if (both tried): the picture holds classes that the pattern leaves, or lacks exact light that it
// takes.
TEST(PathClasses, PictureOfAPatternIsTheSumOfItsLayers) {
  const Rendering render(full_scene(), 8, 6);
  for (const char* pattern :
       {"E D D L", "E . .* L", "E G .* La", "E L", "E D L", "E G Lp", "E .* Le", "E D .{2,} L"}) {
    SCOPED_TRACE(pattern);
    PathTracerSettings s = settings(Estimator::light_vertex, 16, 4, all_paths(0, 4));
    s.class_bounces = 2;
    s.pattern = pattern;
    const PathTracerResult result = render(local, s);
    const std::vector<size_t> chosen = select_paths(pattern, classes_of(result.layers));
    ASSERT_FALSE(chosen.empty());
    const Image sum = sum_of(result.layers, chosen);
    EXPECT_GT(mean_of(sum).x, 1e-4) << "the pattern must take some light";
    expect_same_picture(sum, result.total());
  }
}

// Red if (tried): the pattern changes what layers hold.
TEST(PathClasses, LayersHoldAllClassesWhateverThePattern) {
  const Rendering render(full_scene(), 8, 6);
  PathTracerSettings s = settings(Estimator::next_event, 16, 4, all_paths(1, 2));
  s.class_bounces = 2;
  const std::vector<PathLayer> all = render(local, s).layers;
  s.pattern = "E D D L";
  const std::vector<PathLayer> some = render(local, s).layers;
  for (const PathLayer& layer : some) {
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const PathLayer& l) { return l.path_class == layer.path_class; });
    ASSERT_NE(same, all.end()) << layer.path_class.name();
    for (size_t i = 0; i < layer.mean.pixels.size(); ++i)
      EXPECT_EQ(layer.mean.pixels[i], same->mean.pixels[i]);
  }
}

// Red if (tried): two classes of a picture share a name (a layer of the EXR file would be lost).
TEST(PathClasses, HaveNamesOfTheirOwn) {
  const PathClasses classes(3, all_paths(0, 9), true, true, true);
  std::set<std::string> names;
  for (const PathClass& c : DirectImage::classes()) names.insert(c.name());
  for (const PathClass& c : classes.classes()) names.insert(c.name());
  EXPECT_EQ(names.size(), classes.count() + DirectImage::classes().size());
  EXPECT_TRUE(names.contains("b1.D.D.local") && names.contains("b4+.G.some_G.environment"));
}

// Red if (tried): a sample that is not a number is looked for in a class that can't be.
TEST(PathClasses, CountSamplesThatAreNotFinite) {
  Scene scene = room();
  scene.materials[0].diffuse.y = std::numeric_limits<float>::quiet_NaN();
  const Rendering render(std::move(scene), 8, 6);
  for (const Estimator estimator : {Estimator::next_event, Estimator::light_vertex}) {
    PathTracerSettings s = settings(estimator, 4, 2, bounces(1, 2));
    s.class_bounces = 2;
    const PathTracerResult result = render(local, s);
    EXPECT_GT(result.non_finite, 0);
    for (const PathLayer& layer : result.layers)
      for (const glm::vec3& p : layer.mean.pixels) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
  }
}

// Red if (each tried): a pattern without classes, or one that selects nothing, gives a black picture
// without a word.
TEST(PathClasses, RefusePatternsThatCannotBeAnswered) {
  const Rendering render(room(), 8, 6);
  PathTracerSettings s = settings(Estimator::next_event, 4, 2);
  s.pattern = "E D D L";
  EXPECT_THROW(render(local, s), Error);
  s.class_bounces = 2;
  EXPECT_NO_THROW(render(local, s));
  s.pattern = "E D D D L";
  EXPECT_THROW(render(local, s), Error) << "there is one bounce only";
}

}  // namespace
}  // namespace relight::tiny
