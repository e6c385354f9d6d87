#include "common/sampling/surface_pieces.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>

namespace relight {
namespace {

struct Cutter {
  const Scene& scene;
  double largest;
  std::vector<SurfacePiece>& pieces;
  uint32_t triangle = 0;

  glm::vec3 point(const glm::vec2& uv) const {
    const Triangle& t = scene.triangles[triangle];
    const glm::vec3 a = scene.positions[t.v[0]], b = scene.positions[t.v[1]], c = scene.positions[t.v[2]];
    return a + uv.x * (b - a) + uv.y * (c - a);
  }

  // depth only guards against rounding: each cut halves the area.
  void cut(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c, double area, int depth) {
    if (area <= largest || depth > 40) return add(a, b, c, area);
    const glm::vec3 pa = point(a), pb = point(b), pc = point(c);
    const float ab = glm::distance(pa, pb), bc = glm::distance(pb, pc), ca = glm::distance(pc, pa);
    if (bc >= ab && bc >= ca) return halve(b, c, a, area, depth);
    if (ca >= ab) return halve(c, a, b, area, depth);
    halve(a, b, c, area, depth);
  }

  void halve(const glm::vec2& a, const glm::vec2& b, const glm::vec2& opposite, double area, int depth) {
    const glm::vec2 middle = 0.5f * (a + b);
    cut(a, middle, opposite, 0.5 * area, depth + 1);
    cut(middle, b, opposite, 0.5 * area, depth + 1);
  }

  void add(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c, double area) {
    const glm::vec3 centroid = point((a + b + c) / 3.0f);
    for (const bool flipped : {false, true})
      pieces.push_back({triangle, flipped, {a, b, c}, static_cast<float>(area), 1.0f, centroid});
  }
};

}  // namespace

std::vector<SurfacePiece> cut_surfaces(const Scene& scene, double largest) {
  std::vector<SurfacePiece> pieces;
  pieces.reserve(2 * scene.triangles.size());
  Cutter cutter{scene, largest, pieces};
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const double area = 0.5 * glm::length(glm::dvec3(scene.area_normal(t)));
    cutter.triangle = static_cast<uint32_t>(t);
    if (static_cast<float>(area) > 0.0f) cutter.cut({0, 0}, {1, 0}, {0, 1}, area, 0);
  }
  return pieces;
}

void apply_importance(std::vector<SurfacePiece>& pieces, const ImportanceMap& map, float least, bool binary) {
  if (!(map.total_weight() > 0.0)) return;  // the camera sees nothing: no reason to prefer any surface
  std::vector<SurfacePiece> reached;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(reached),
               [&map](const SurfacePiece& p) { return map.reached(p.centroid, p.triangle, p.flipped); });
  if (reached.empty()) return;  // no particle landed in the layer of a piece's centroid
  std::unordered_map<uint64_t, double> area;
  for (const SurfacePiece& p : reached) area[map.bin(p.centroid, p.triangle, p.flipped)] += p.area;
  const double mean = map.total_weight() / total_area(reached);
  for (SurfacePiece& p : reached) {
    const uint64_t bin = map.bin(p.centroid, p.triangle, p.flipped);
    p.importance = binary ? 1.0f : std::max(least, static_cast<float>(map.weight(bin) / area[bin] / mean));
  }
  pieces = std::move(reached);
}

double total_area(const std::vector<SurfacePiece>& pieces) {
  double sum = 0.0;
  for (const SurfacePiece& p : pieces) sum += p.area;
  return sum;
}

}  // namespace relight
