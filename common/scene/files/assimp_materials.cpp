#include "common/scene/files/assimp_materials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>

#include "common/run/error.h"
#include "common/scene/files/image_file.h"
#include "common/scene/files/material_conversion.h"

namespace relight {

namespace {

template <typename T>
void read(const aiMaterial& material, const char* key, unsigned type, unsigned index, T& value) {
  T found{};
  if (material.Get(key, type, index, found) == aiReturn_SUCCESS) value = found;
}

void read(const aiMaterial& material, const char* key, unsigned type, unsigned index, glm::vec3& value) {
  aiColor4D found;
  if (material.Get(key, type, index, found) == aiReturn_SUCCESS) value = {found.r, found.g, found.b};
}

bool is_gltf(const std::filesystem::path& file) {
  return has_ending(file, ".gltf") || has_ending(file, ".glb");
}

FileMaterial read_material(const aiMaterial& source, const std::filesystem::path& file) {
  FileMaterial m;
  m.name = source.GetName().C_Str();
  read(source, AI_MATKEY_COLOR_DIFFUSE, m.base);
  read(source, AI_MATKEY_COLOR_EMISSIVE, m.emission);
  read(source, AI_MATKEY_ROUGHNESS_FACTOR, m.roughness);
  read(source, AI_MATKEY_METALLIC_FACTOR, m.metallic);
  if (is_gltf(file)) {
    read(source, AI_MATKEY_BASE_COLOR, m.base);
    m.specular_from_base = true;
    return m;
  }
  read(source, AI_MATKEY_COLOR_SPECULAR, m.specular);
  read(source, AI_MATKEY_SHININESS, m.phong_exponent);
  read(source, AI_MATKEY_OPACITY, m.opacity);
  return m;
}

}  // namespace

int AssimpMaterials::index(unsigned assimp_index) {
  const auto [entry, added] = converted_.try_emplace(assimp_index, clear_glass);
  if (added) entry->second = convert(*source_.mMaterials[assimp_index]);
  return entry->second;
}

int AssimpMaterials::convert(const aiMaterial& source) {
  // PLY has no materials; what assimp makes up for it is glossy and brighter than light.
  if (has_ending(file_, ".ply")) {
    scene_.materials.emplace_back();
    return static_cast<int>(scene_.materials.size() - 1);
  }
  FileMaterial file_material = read_material(source, file_);
  if (lets_light_straight_through(file_material)) return clear_glass;
  if (file_material.opacity < 1.0f) ++scene_.repairs.counts["translucent_materials_made_opaque"];
  const int texture = diffuse_texture(source);
  file_material.has_texture = texture >= 0;
  if (options_.srgb_colours) file_material.base = srgb_to_linear(file_material.base);
  aiString ignored;
  if (file_material.specular_from_base &&
      source.GetTexture(aiTextureType_METALNESS, 0, &ignored) == aiReturn_SUCCESS) {
    // Its factor alone would turn the whole surface into metal.
    file_material.metallic = 0.0f;
    ++scene_.repairs.counts["metallic_textures_ignored"];
  }
  Material material = convert_material(file_material);
  if (material.diffuse != glm::vec3(0.0f)) material.diffuse_texture = texture;
  scene_.materials.push_back(material);
  return static_cast<int>(scene_.materials.size() - 1);
}

int AssimpMaterials::diffuse_texture(const aiMaterial& material) {
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    aiString path;
    if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS) continue;
    const auto [entry, added] = textures_.try_emplace(path.C_Str(), -1);
    if (!added) return entry->second;
    try {
      entry->second = load(path.C_Str());
    } catch (const Error& error) {
      ++scene_.repairs.counts["textures_missing"];
      scene_.repairs.warnings.push_back(fmt::format("{}: texture of material '{}' left out: {}",
                                                    file_.string(), material.GetName().C_Str(),
                                                    error.what()));
    }
    return entry->second;
  }
  return -1;
}

int AssimpMaterials::load(const std::string& path) {
  if (const aiTexture* embedded = source_.GetEmbeddedTexture(path.c_str())) {
    const std::string name = fmt::format("{}: embedded texture {}", file_.string(), path);
    if (embedded->mHeight != 0) fail("{}: raw texels are not supported", name);
    scene_.textures.push_back(load_texture_from_memory(
        {reinterpret_cast<const unsigned char*>(embedded->pcData), embedded->mWidth}, name));
  } else {
    std::string portable = path;  // MTL files written on Windows use backslashes
    for (char& c : portable)
      if (c == '\\') c = '/';
    scene_.textures.push_back(load_texture(file_.parent_path() / portable));
  }
  return static_cast<int>(scene_.textures.size() - 1);
}

}  // namespace relight
