#include "common/scene/files/material_toml.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "common/run/error.h"
#include "common/scene/files/image_file.h"
#include "common/scene/files/material_conversion.h"

namespace relight {

namespace {

const NumberRange albedo{0.0, 1.0}, exponents{0.0, double(largest_exponent)},
    alphas{double(smallest_alpha), 1.0};

// In the order of BrdfModel, with the parameters that scene files accept for each.
struct ModelKeys {
  std::string name;
  std::vector<std::string> keys;
};
const ModelKeys models[] = {
    {"phong", {"glossy", "exponent", "roughness"}},
    {"ashikhmin_shirley", {"glossy", "exponent", "exponent_u", "exponent_v"}},
    {"lafortune", {"lobe"}},
    {"ggx", {"glossy", "alpha", "alpha_u", "alpha_v", "roughness"}},
};

BrdfModel read_model(const TomlTable& table, BrdfModel own) {
  std::vector<std::string> names;
  for (const ModelKeys& model : models) names.push_back(model.name);
  const std::string name = table.text("model", names[static_cast<size_t>(own)], names);
  return static_cast<BrdfModel>(std::find(names.begin(), names.end(), name) - names.begin());
}

// A parameter of another model would be ignored in silence.
void refuse_keys_of_other_models(const TomlTable& table, BrdfModel chosen) {
  const ModelKeys& own = models[static_cast<size_t>(chosen)];
  for (const ModelKeys& model : models)
    for (const std::string& key : model.keys)
      if (table.has(key) && std::find(own.keys.begin(), own.keys.end(), key) == own.keys.end())
        fail("{}: not a parameter of the material's model '{}'; valid: {}; or give model = \"{}\"",
             table.where(key), own.name, fmt::join(own.keys, ", "), model.name);
}

void refuse_both(const TomlTable& table, const std::string& one, const std::string& other) {
  if (table.has(one) && table.has(other))
    fail("{}: give either {} or {}, not both", table.where(other), one, other);
}

// key for both directions, or key_u and key_v. `needed`: no value to fall back on.
glm::vec2 read_pair(const TomlTable& table, const std::string& key, const glm::vec2& fallback, bool needed,
                    const NumberRange& range) {
  const std::string u = key + "_u", v = key + "_v";
  refuse_both(table, key, u);
  refuse_both(table, key, v);
  if (table.has(key)) return glm::vec2(static_cast<float>(table.number(key, 0.0, range)));
  if (needed && !(table.has(u) && table.has(v)))
    fail("{}: the model needs {}, or {} and {}", table.where(), key, u, v);
  return {static_cast<float>(table.number(u, double(fallback.x), range)),
          static_cast<float>(table.number(v, double(fallback.y), range))};
}

GlossyPart read_phong(const TomlTable& table, const glm::vec3& glossy, float fallback) {
  refuse_both(table, "exponent", "roughness");
  float exponent = static_cast<float>(table.number("exponent", double(fallback), exponents));
  if (table.has("roughness"))
    exponent = phong_exponent_from_roughness(static_cast<float>(table.number("roughness", 0.0, {0.0, 1.0})));
  return phong_part(glossy, exponent);
}

GlossyPart read_ggx(const TomlTable& table, const glm::vec3& glossy, const GlossyPart& own, bool needed) {
  for (const char* key : {"alpha", "alpha_u", "alpha_v"}) refuse_both(table, key, "roughness");
  if (table.has("roughness")) {
    const float roughness = static_cast<float>(table.number("roughness", 0.0, {0.0, 1.0}));
    return ggx_part(glossy, roughness * roughness, roughness * roughness);
  }
  const glm::vec2 alpha = read_pair(table, "alpha", {own.exponent, own.shape.exponent_v}, needed, alphas);
  return ggx_part(glossy, alpha.x, alpha.y);
}

LafortuneLobe read_lobe(const TomlTable& table) {
  for (const char* key : {"c", "exponent", "albedo"}) table.require(key);
  const glm::vec3 c = table.vector("c", glm::vec3(0.0f));
  LafortuneLobe lobe{c.x, c.y, c.z, 0.0f, table.colour("albedo", glm::vec3(0.0f), albedo)};
  lobe.exponent = static_cast<float>(table.number("exponent", 0.0, exponents));
  table.refuse_unknown_keys();
  if (!(c.z > 0.0f) || !(std::max(std::abs(c.x), std::abs(c.y)) <= 8.0f * c.z))
    fail("{}: ({}, {}, {}); valid: [cx, cy, cz] with cz > 0 and |cx|, |cy| <= 8 cz", table.where("c"), c.x,
         c.y, c.z);
  return lobe;
}

GlossyPart read_lafortune(const TomlTable& table, const GlossyPart& own, bool needed) {
  if (needed) table.require("lobe");
  if (!table.has("lobe")) return own;
  std::vector<LafortuneLobe> lobes;
  for (const TomlTable& lobe : table.tables("lobe")) lobes.push_back(read_lobe(lobe));
  if (lobes.empty() || lobes.size() > 3)
    fail("{}: {} lobes; valid: 1 to 3", table.where("lobe"), lobes.size());
  return lafortune_part(lobes);
}

GlossyPart read_glossy_part(const TomlTable& table, const GlossyPart& own) {
  const BrdfModel model = read_model(table, own.model());
  refuse_keys_of_other_models(table, model);
  const bool changed = model != own.model();
  if (model == BrdfModel::lafortune) return read_lafortune(table, own, changed);
  const glm::vec3 glossy = table.colour("glossy", own.glossy, albedo);
  if (model == BrdfModel::phong) return read_phong(table, glossy, changed ? 1.0f : own.exponent);
  if (model == BrdfModel::ggx) return read_ggx(table, glossy, own, changed);
  const glm::vec2 pair =
      read_pair(table, "exponent", {own.exponent, own.shape.exponent_v}, changed, exponents);
  return ashikhmin_shirley_part(glossy, pair.x, pair.y);
}

// Index of the texture, -1 for none.
int read_texture(const TomlTable& table, Scene& scene) {
  if (!table.has("diffuse_texture") || table.text("diffuse_texture", "").empty()) return -1;
  const std::filesystem::path file = table.file("diffuse_texture");
  if (!std::filesystem::is_regular_file(file))
    fail("{}: no such image file: {}", table.where("diffuse_texture"), file.string());
  scene.textures.push_back(load_texture(file));
  return static_cast<int>(scene.textures.size() - 1);
}

std::vector<Material*> find_materials(Scene& scene, const TomlTable& table) {
  table.require("name");
  const std::string name = table.text("name", "");
  std::vector<Material*> found;
  std::vector<std::string> names;
  for (Material& m : scene.materials) {
    names.push_back(m.name);
    if (m.name == name) found.push_back(&m);
  }
  if (found.empty())
    fail("{}: no material '{}'; the scene's materials: {}", table.where("name"), name,
         fmt::join(names, ", "));
  return found;
}

void require_albedo_up_to_one(const TomlTable& table, const Material& material) {
  const glm::vec3 sum = material.diffuse + largest_albedo(material.glossy_part());
  if (std::max({sum.x, sum.y, sum.z}) > 1.0f)
    fail(
        "{}: diffuse + glossy of material '{}' is ({}, {}, {}){}; valid: <= 1, or the surface would create "
        "light",
        table.where(), material.name, sum.x, sum.y, sum.z,
        material.glossy_part().model() == BrdfModel::lafortune ? " at the angle where its lobes reflect most"
                                                               : "");
}

}  // namespace

void read_material(const TomlTable& table, Scene& scene) {
  const int texture = read_texture(table, scene);
  for (Material* m : find_materials(scene, table)) {
    m->diffuse = table.colour("diffuse", m->diffuse, albedo);
    m->set_glossy_part(read_glossy_part(table, m->glossy_part()));
    m->emission = table.colour("emission", m->emission, {0.0});
    if (table.has("diffuse_texture")) m->diffuse_texture = texture;
    require_albedo_up_to_one(table, *m);
  }
  table.refuse_unknown_keys();
}

}  // namespace relight
