#include "common/scene/validation.h"
#include "common/finite.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/run/error.h"
#include "common/scene/mesh_repair.h"

namespace relight {

namespace {

void count(Scene& scene, const char* what, int64_t n) {
  if (n > 0) scene.repairs.counts[what] += n;
}

int64_t unused_vertices(const Scene& scene) {
  std::vector<bool> used(scene.positions.size(), false);
  for (const Triangle& t : scene.triangles)
    for (uint32_t v : t.v) used[v] = true;
  return std::count(used.begin(), used.end(), false);
}

}  // namespace

void require_valid_indices(const Scene& scene) {
  const auto check = [&](size_t t, const char* what, size_t index, size_t size) {
    if (index >= size)
      fail("{}: triangle {}: {} index {}; the scene has {}", scene.name, t, what, index, size);
  };
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    for (uint32_t v : scene.triangles[t].v) check(t, "vertex", v, scene.positions.size());
    check(t, "material", scene.triangles[t].material, scene.materials.size());
    check(t, "object", scene.triangles[t].object, scene.object_names.size());
  }
  for (const Material& m : scene.materials)
    if (m.diffuse_texture >= static_cast<int>(scene.textures.size()))
      fail("{}: material '{}': texture index {}; the scene has {}", scene.name, m.name, m.diffuse_texture,
           scene.textures.size());
}

void remove_faulty_triangles(Scene& scene) {
  const auto corners_finite = [&](const Triangle& t) {
    return finite(scene.positions[t.v[0]]) && finite(scene.positions[t.v[1]]) &&
           finite(scene.positions[t.v[2]]);
  };
  count(scene, "non_finite_triangles_removed",
        static_cast<int64_t>(
            std::erase_if(scene.triangles, [&](const Triangle& t) { return !corners_finite(t); })));
  // CGAL's predicates must not see NaN, not even in unused vertices.
  for (glm::vec3& p : scene.positions)
    if (!finite(p)) p = glm::vec3(0.0f);
  const std::vector<TriangleFault> faults = find_triangle_faults(scene.positions, scene.triangles);
  count(scene, "zero_area_triangles_removed",
        std::count(faults.begin(), faults.end(), TriangleFault::zero_area));
  count(scene, "duplicate_triangles_removed",
        std::count(faults.begin(), faults.end(), TriangleFault::duplicate));
  size_t kept = 0;
  for (size_t t = 0; t < faults.size(); ++t)
    if (faults[t] == TriangleFault::none) scene.triangles[kept++] = scene.triangles[t];
  scene.triangles.resize(kept);
  if (scene.triangles.empty()) fail("{}: no triangle is left after removing faulty ones", scene.name);
}

void repair_uvs(Scene& scene) {
  int64_t repaired = 0;
  for (glm::vec2& uv : scene.uvs) {
    if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
    uv = glm::vec2(0.0f);
    ++repaired;
  }
  count(scene, "non_finite_uvs_set_to_0", repaired);
}

namespace {

// Returns 1 if a channel was negative.
int64_t clamp_negative(glm::vec3& value, const Material& material, const char* field,
                       const std::string& scene) {
  if (!finite(value))
    fail("{}: material '{}': {} is ({}, {}, {}); it must be finite", scene, material.name, field, value.x,
         value.y, value.z);
  const glm::vec3 clamped = glm::max(value, glm::vec3(0.0f));
  const bool changed = clamped != value;
  value = clamped;
  return changed;
}

// Largest texel of the material's texture, per channel; 1 without one.
glm::vec3 brightest_texel(const Scene& scene, const Material& material) {
  if (material.diffuse_texture < 0) return glm::vec3(1.0f);
  glm::vec3 brightest(0.0f);
  for (const glm::vec3& texel : scene.textures[static_cast<size_t>(material.diffuse_texture)].texels)
    brightest = glm::max(brightest, texel);
  return brightest;
}

// Limits the glossy part to an albedo of 1 at every angle, and returns its largest.
glm::vec3 limit_glossy(Material& material) {
  material.glossy = glm::min(material.glossy, glm::vec3(1.0f));
  const glm::vec3 largest = largest_albedo(material.glossy_part());
  const float most = std::max({largest.x, largest.y, largest.z});
  if (!(most > 1.0f)) return largest;
  material.glossy /= most;
  return largest / most;
}

// Scales the diffuse part, hue kept, so that it reflects no more than the glossy part leaves over.
bool limit_albedo(const Scene& scene, Material& material) {
  const Material before = material;
  const glm::vec3 glossy = limit_glossy(material);
  const glm::vec3 diffuse = material.diffuse * brightest_texel(scene, material);
  float scale = 1.0f;
  for (int k = 0; k < 3; ++k)
    if (diffuse[k] + glossy[k] > 1.0f) scale = std::min(scale, (1.0f - glossy[k]) / diffuse[k]);
  material.diffuse *= scale;
  return material.diffuse != before.diffuse || material.glossy != before.glossy;
}

}  // namespace

void repair_materials(Scene& scene) {
  int64_t negative = 0, too_bright = 0;
  for (Material& m : scene.materials) {
    int64_t changed = clamp_negative(m.diffuse, m, "diffuse", scene.name);
    changed += clamp_negative(m.glossy, m, "glossy", scene.name);
    changed += clamp_negative(m.emission, m, "emission", scene.name);
    for (const float exponent : {m.exponent, m.shape.exponent_v, m.shape.exponent_w})
      if (!std::isfinite(exponent))
        fail("{}: material '{}': exponent is {}; it must be finite", scene.name, m.name, exponent);
    changed += m.exponent < 0.0f;
    m.exponent = std::max(m.exponent, 0.0f);
    negative += changed > 0;
    too_bright += limit_albedo(scene, m);
  }
  count(scene, "materials_with_negative_values_clamped", negative);
  count(scene, "materials_with_albedo_above_1_scaled", too_bright);
}

void warn_of_far_origin(Scene& scene) {
  Bounds bounds;
  for (const Triangle& t : scene.triangles)
    for (const uint32_t v : t.v) bounds.add(scene.positions[v]);
  const double size = static_cast<double>(bounds.diagonal());
  const glm::dvec3 far = glm::max(glm::abs(glm::dvec3(bounds.lo)), glm::abs(glm::dvec3(bounds.hi)));
  const double blur = 32.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
                      std::max({far.x, far.y, far.z}) / size;
  if (size > 0.0 && blur > 1e-3)
    scene.repairs.warnings.push_back(
        fmt::format("{}: lies {:.0f} times its own size from the origin, where single precision blurs it by "
                    "{:.2g} of its size: "
                    "expect false shadows and leaks; move it towards the origin",
                    scene.name, std::max({far.x, far.y, far.z}) / size, blur));
}

void repair_scene(Scene& scene) {
  require_valid_indices(scene);
  count(scene, "unused_vertices_removed", unused_vertices(scene));
  remove_faulty_triangles(scene);
  repair_normals(scene);
  repair_uvs(scene);
  compact_vertices(scene);
  repair_materials(scene);
  warn_of_far_origin(scene);
}

}  // namespace relight
