#include "common/scene/mesh_repair.h"

#include <array>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include "common/scene/topology.h"

namespace relight {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// A polygon of the soup that remembers where it comes from while CGAL moves it around.
struct SoupTriangle : std::array<size_t, 3> {
  size_t source = 0;
};

bool has_no_area(const Kernel::Point_3& a, const Kernel::Point_3& b, const Kernel::Point_3& c) {
  if (CGAL::collinear(a, b, c)) return true;
  // Shading normalises the single-precision cross product of the edges: it must not have vanished.
  const auto edge = [](const Kernel::Point_3& from, const Kernel::Point_3& to) {
    return glm::vec3(float(to.x()), float(to.y()), float(to.z())) -
           glm::vec3(float(from.x()), float(from.y()), float(from.z()));
  };
  const glm::vec3 normal = glm::cross(edge(a, b), edge(a, c));
  return !(glm::dot(normal, normal) > 0.0f);
}

}  // namespace

std::vector<TriangleFault> find_triangle_faults(const std::vector<glm::vec3>& positions,
                                                const std::vector<Triangle>& triangles) {
  std::vector<Kernel::Point_3> points;
  points.reserve(positions.size());
  for (const glm::vec3& p : positions) points.emplace_back(p.x, p.y, p.z);
  // Hashed here rather than merged by CGAL: a third of the repair time of a mesh with a million vertices.
  const std::vector<uint32_t> welded = weld_positions(positions);
  std::vector<TriangleFault> faults(triangles.size(), TriangleFault::none);
  std::vector<SoupTriangle> soup;
  for (size_t t = 0; t < triangles.size(); ++t) {
    const uint32_t* v = triangles[t].v;
    if (has_no_area(points[v[0]], points[v[1]], points[v[2]])) {
      faults[t] = TriangleFault::zero_area;
      continue;
    }
    SoupTriangle polygon;
    for (size_t k = 0; k < 3; ++k) polygon[k] = welded[v[k]];
    polygon.source = t;
    soup.push_back(polygon);
    faults[t] = TriangleFault::duplicate;  // until it is found among the survivors
  }
  pmp::merge_duplicate_polygons_in_polygon_soup(points, soup);
  for (const SoupTriangle& survivor : soup) faults[survivor.source] = TriangleFault::none;
  return faults;
}

}  // namespace relight
