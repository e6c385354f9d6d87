#include "experiments/mitsuba/shapes.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "experiments/mitsuba/bsdfs.h"
#include "experiments/mitsuba/ply_file.h"

namespace relight::mitsuba {

namespace {

// Distance of an emitter's back from its front, in units of the scene's largest coordinate: more than float
// resolves there, too little to be seen.
constexpr float back_distance = 1e-5f;

// Letters, digits, '-' and '_' of an object's name, for people who look into the folder.
std::string file_name(size_t number, const std::string& object) {
  std::string name;
  for (const char c : object) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    name += plain || c == '-' ? c : '_';
    if (name.size() == 40) break;
  }
  return fmt::format("{:05}-{}", number, name);
}

float largest_coordinate(const Bounds& bounds) {
  const glm::vec3 m = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
  return std::max({m.x, m.y, m.z});
}

void write_shape(XmlWriter& xml, const std::string& file, size_t index, const Material& material) {
  xml.open("shape", {{"type", "ply"}});
  xml.value("string", "filename", file);
  xml.leaf("ref", {{"id", bsdf_id(index)}});
  if (material.emission != glm::vec3(0.0f)) {
    xml.open("emitter", {{"type", "area"}});
    xml.rgb("radiance", material.emission);
    xml.close();
  }
  xml.close();
}

}  // namespace

ShapeCounts write_shapes(XmlWriter& xml, const Scene& scene, const std::filesystem::path& folder) {
  std::map<std::pair<uint32_t, uint32_t>, MeshPart> parts;  // by object and material
  for (size_t t = 0; t < scene.triangles.size(); ++t)
    parts[{scene.triangles[t].object, scene.triangles[t].material}].triangles.push_back(
        static_cast<uint32_t>(t));
  ShapeCounts counts;
  for (auto& [key, part] : parts) {
    const auto [object, index] = key;
    const Material& material = scene.materials[index];
    const std::string name =
        "meshes/" + file_name(static_cast<size_t>(counts.meshes), scene.object_names[object]);
    write_ply(folder / (name + ".ply"), scene, part);
    write_shape(xml, name + ".ply", index, material);
    ++counts.meshes, counts.triangles += static_cast<int64_t>(part.triangles.size());
    if (material.emission == glm::vec3(0.0f)) continue;
    part.back = true, part.behind = back_distance * largest_coordinate(scene.bounds);
    write_ply(folder / (name + ".reverse.ply"), scene, part);
    write_shape(xml, name + ".reverse.ply", index, material);
    ++counts.emitter_backs;
  }
  return counts;
}

}  // namespace relight::mitsuba
