// Light paths as data: every path that the reference finds belongs to one class, and radiance is accumulated
// for each class in one pass. The sum of all classes is the whole picture; the sum of some of them is what a
// method that carries those paths should give.
//
// A class is told by the number of bounces, the lobe at the visible surface (D or G), whether all vertices
// behind it reflect diffusely or some glossily, and by what the path ends on. Each vertex's BRDF is split
// into its diffuse and glossy part whatever lobe was sampled, so that the split is exact.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "common/run/light_paths.h"

namespace relight {

// What a path ends on: a delta light; a light or surface with an area; the environment.
enum class LightEnd { local = 0, area = 1, environment = 2 };

// RGB radiance by lobe: value[eye glossy][some interior vertex glossy].
struct SplitRadiance {
  glm::vec3 value[2][2] = {{glm::vec3(0.0f), glm::vec3(0.0f)}, {glm::vec3(0.0f), glm::vec3(0.0f)}};
  glm::vec3 sum() const { return (value[0][0] + value[0][1]) + (value[1][0] + value[1][1]); }
};

struct PathClass {
  int bounces = 0;       // vertices between the visible surface and the light; -1: the emitter itself is seen
  bool or_more = false;  // "and all longer paths"
  bool glossy_at_eye = false;
  bool glossy_interior = false;
  LightEnd end = LightEnd::local;
  // E.g. "b1.D.D.local", "b5+.G.some_G.environment", "seen.area"; the layer's name in EXR files.
  std::string name() const;
  bool operator==(const PathClass&) const = default;
};

class PathClasses {
 public:
  // One accumulator for everything.
  PathClasses() = default;
  // A class for each bounce count up to `most_bounces` and one for more, times the lobes and ends that can
  // occur under `paths`: `glossy` if any material is, `area` and `environment` if such light exists. The
  // class for more begins at min_bounces if that is larger.
  PathClasses(int most_bounces, const LightPaths& paths, bool glossy, bool area, bool environment);

  // False: one accumulator.
  bool told_apart() const { return told_apart_; }
  // Accumulators; at least one, even where no class can occur (the direct image may be all there is).
  size_t count() const { return std::max<size_t>(1, classes_.size()); }
  const std::vector<PathClass>& classes() const { return classes_; }
  // Which classes make up the picture; all, unless select() was called. `chosen` has count() entries.
  bool selected(size_t c) const { return chosen_.empty() || chosen_[c] != 0; }
  void select(std::vector<uint8_t> chosen) { chosen_ = std::move(chosen); }
  // Adds radiance of a path with `bounces` >= 0 to its classes' places in sums[0, count()).
  void add(int bounces, LightEnd end, const SplitRadiance& radiance, glm::vec3* sums) const {
    if (told_apart_)
      add_apart(bounces, end, radiance, sums);
    else
      *sums += radiance.sum();
  }
  // The same for a path whose vertices are all diffuse.
  void add_diffuse(int bounces, LightEnd end, const glm::vec3& radiance, glm::vec3* sums) const {
    if (told_apart_)
      add_apart(bounces, end, {{{radiance, glm::vec3(0.0f)}, {glm::vec3(0.0f), glm::vec3(0.0f)}}}, sums);
    else
      *sums += radiance;
  }

 private:
  void add_apart(int bounces, LightEnd end, const SplitRadiance& radiance, glm::vec3* sums) const;

  bool told_apart_ = false;
  int last_ = 0;  // bounce counts from here on share a class
  std::vector<PathClass> classes_;
  std::vector<uint8_t> chosen_;
  // Place of (bounces, end, eye, interior), -1 where nothing can arrive.
  std::vector<int> place_;
  static size_t slot(int bounces, LightEnd end, int eye, int interior) {
    return static_cast<size_t>(((bounces * 3 + static_cast<int>(end)) * 2 + eye) * 2 + interior);
  }
};

}  // namespace relight
