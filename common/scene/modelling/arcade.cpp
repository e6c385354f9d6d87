#include <cmath>
#include <numbers>

#include "common/scene/modelling/surfaces.h"

namespace relight::modelling {

namespace {

// One point of the wall's lower edge, and the edge's normal on either side of it (pointing down out of the
// wall).
struct EdgePoint {
  glm::dvec2 position, normal_before, normal_after;
};

std::vector<EdgePoint> lower_edge(const Arcade& shape) {
  const glm::dvec2 down(0.0, -1.0);
  const double bay = (shape.length - 2.0 * shape.end) / shape.bays;
  std::vector<EdgePoint> edge = {{{-0.5 * shape.length, shape.spring}, down, down}};
  for (int b = 0; b < shape.bays; ++b) {
    const double centre = -0.5 * shape.length + shape.end + (b + 0.5) * bay;
    for (int i = 0; i <= shape.segments; ++i) {
      const double a = std::numbers::pi * (1.0 - double(i) / shape.segments);
      const bool end = i == 0 || i == shape.segments;
      const glm::dvec2 out(end ? (i == 0 ? -1.0 : 1.0) : std::cos(a), end ? 0.0 : std::sin(a));
      const glm::dvec2 inward = -out;
      edge.push_back({glm::dvec2(centre, shape.spring) + shape.radius * out, i == 0 ? down : inward,
                      i == shape.segments ? down : inward});
    }
  }
  edge.push_back({{0.5 * shape.length, shape.spring}, down, down});
  return edge;
}

}  // namespace

void arcade(MeshBuilder& mesh, const Frame& frame, const Arcade& shape) {
  const double z = 0.5 * shape.thickness;
  const auto point = [&](double x, double y, double depth) { return frame.point({x, y, depth}); };
  const std::vector<EdgePoint> edge = lower_edge(shape);
  for (size_t i = 0; i + 1 < edge.size(); ++i) {
    const glm::dvec2 a = edge[i].position, b = edge[i + 1].position;
    const double top = shape.top;
    mesh.face(point(a.x, a.y, z), point(b.x, b.y, z), point(b.x, top, z), point(a.x, top, z));
    mesh.face(point(b.x, b.y, -z), point(a.x, a.y, -z), point(a.x, top, -z), point(b.x, top, -z));
    mesh.face(point(a.x, top, z), point(b.x, top, z), point(b.x, top, -z), point(a.x, top, -z));
    const glm::dvec3 na = frame.vector({edge[i].normal_after, 0.0});
    const glm::dvec3 nb = frame.vector({edge[i + 1].normal_before, 0.0});
    mesh.quad(mesh.vertex(point(a.x, a.y, -z), na), mesh.vertex(point(b.x, b.y, -z), nb),
              mesh.vertex(point(b.x, b.y, z), nb), mesh.vertex(point(a.x, a.y, z), na));
  }
  const double x = 0.5 * shape.length, low = shape.spring, top = shape.top;
  mesh.face(point(x, low, z), point(x, low, -z), point(x, top, -z), point(x, top, z));
  mesh.face(point(-x, low, -z), point(-x, low, z), point(-x, top, z), point(-x, top, -z));
}

}  // namespace relight::modelling
