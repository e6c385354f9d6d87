// Mesh files through assimp: OBJ (+ MTL), glTF, GLB, PLY.
#pragma once

#include <filesystem>

#include "common/scene/scene.h"

namespace relight {

struct MeshFileOptions {
  glm::mat4 transform{1.0f};  // from file coordinates to scene coordinates
  bool srgb_colours = false;  // diffuse colours (not textures, not Ks) are sRGB-encoded numbers
  std::string object_prefix;  // put before each object's name
};

// Appends the file's triangles, materials and textures to the scene, as they are in the file except for what
// relight cannot show: points, lines and clear glass are left out and counted. Missing normals are left (0,
// 0, 0) for repair_scene. A missing texture or material library is a warning in scene.repairs; a file that
// can't be read or holds no triangle is an Error naming it.
void append_mesh_file(Scene& scene, const std::filesystem::path& file, const MeshFileOptions& options = {});

// True if the file name's ending is one that append_mesh_file reads (.obj, .gltf, .glb, .ply, any case).
bool is_mesh_file_name(const std::filesystem::path& file);
// Case-insensitive; ending in lower case with its dot.
bool has_ending(const std::filesystem::path& file, const std::string& ending);

}  // namespace relight
