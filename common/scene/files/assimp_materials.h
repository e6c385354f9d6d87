// Materials and textures of an assimp scene; only for mesh_file.cpp and assimp_materials.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "common/scene/files/mesh_file.h"

struct aiScene;
struct aiMaterial;

namespace relight {

class AssimpMaterials {
 public:
  AssimpMaterials(const aiScene& source, const std::filesystem::path& file, const MeshFileOptions& options,
                  Scene& scene)
      : source_(source), file_(file), options_(options), scene_(scene) {}

  static constexpr int clear_glass = -1;
  // Index into Scene::materials of assimp's material, converted at its first use; or clear_glass.
  int index(unsigned assimp_index);

 private:
  int convert(const aiMaterial& material);
  int diffuse_texture(const aiMaterial& material);
  int load(const std::string& path);

  const aiScene& source_;
  const std::filesystem::path& file_;
  const MeshFileOptions& options_;
  Scene& scene_;
  std::map<unsigned, int> converted_;
  std::map<std::string, int> textures_;
};

}  // namespace relight
