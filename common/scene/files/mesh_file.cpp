#include "common/scene/files/mesh_file.h"

#include <algorithm>
#include <mutex>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>

#include "common/run/error.h"
#include "common/scene/files/assimp_materials.h"
#include "common/scene/files/ply_check.h"

namespace relight {

namespace {

// assimp reports a missing material library only to its log.
class WarningStream : public Assimp::LogStream {
 public:
  explicit WarningStream(std::vector<std::string>& lines) : lines_(lines) {}
  void write(const char* message) override {
    std::string line(message);
    while (!line.empty() && line.back() == '\n') line.pop_back();
    // illum 7 marks glass, which is read from d.
    if (line.find("unexpected illumination model") != std::string::npos) return;
    if (line.find("No object detected") != std::string::npos) return;  // an OBJ without "o" or "g" is fine
    // "Error, T0: OBJ: ..." says nothing more than the rest of the line.
    if (const size_t colon = line.find(": "); colon != std::string::npos) line.erase(0, colon + 2);
    if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
  }

 private:
  std::vector<std::string>& lines_;
};

// Collects assimp's warnings and errors while it lives. The logger is one for the process, hence the lock.
class LogCapture {
 public:
  explicit LogCapture(std::vector<std::string>& lines) : lock_(mutex()) {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(new WarningStream(lines),
                                               Assimp::Logger::Err | Assimp::Logger::Warn);
  }
  ~LogCapture() { Assimp::DefaultLogger::kill(); }

 private:
  static std::mutex& mutex() {
    static std::mutex m;
    return m;
  }
  std::lock_guard<std::mutex> lock_;
};

glm::mat4 to_glm(const aiMatrix4x4& m) {
  return {
      {m.a1, m.b1, m.c1, m.d1}, {m.a2, m.b2, m.c2, m.d2}, {m.a3, m.b3, m.c3, m.d3}, {m.a4, m.b4, m.c4, m.d4}};
}

class MeshAppender {
 public:
  MeshAppender(const aiScene& source, const std::filesystem::path& file, const MeshFileOptions& options,
               Scene& scene)
      : source_(source),
        file_(file),
        options_(options),
        scene_(scene),
        materials_(source, file, options, scene) {}

  void append_node(const aiNode& node, const glm::mat4& parent) {
    const glm::mat4 transform = parent * to_glm(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) append_mesh(*source_.mMeshes[node.mMeshes[i]], transform);
    for (unsigned i = 0; i < node.mNumChildren; ++i) append_node(*node.mChildren[i], transform);
  }

 private:
  void append_mesh(const aiMesh& mesh, const glm::mat4& transform) {
    const int material = materials_.index(mesh.mMaterialIndex);
    if (material == AssimpMaterials::clear_glass) {
      scene_.repairs.counts["clear_glass_triangles_left_out"] += mesh.mNumFaces;
      return;
    }
    if (mesh.HasVertexColors(0)) scene_.repairs.counts["vertex_colours_ignored"] += mesh.mNumVertices;
    const auto first = static_cast<uint32_t>(scene_.positions.size());
    append_vertices(mesh, transform);
    const auto object = static_cast<uint32_t>(scene_.object_names.size());
    scene_.object_names.push_back(options_.object_prefix + mesh.mName.C_Str());
    append_faces(mesh, first, static_cast<uint32_t>(material), object,
                 glm::determinant(glm::mat3(transform)) < 0.0f);
  }

  void append_vertices(const aiMesh& mesh, const glm::mat4& transform) {
    const glm::mat3 normal_transform = glm::transpose(glm::inverse(glm::mat3(transform)));
    const bool plain = transform == glm::mat4(1.0f);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& p = mesh.mVertices[i];
      scene_.positions.push_back(plain ? glm::vec3(p.x, p.y, p.z)
                                       : glm::vec3(transform * glm::vec4(p.x, p.y, p.z, 1)));
      glm::vec3 n(0.0f);
      if (mesh.HasNormals()) n = {mesh.mNormals[i].x, mesh.mNormals[i].y, mesh.mNormals[i].z};
      if (!plain && n != glm::vec3(0.0f)) n = glm::normalize(normal_transform * n);
      scene_.normals.push_back(n);
      const bool has_uv = mesh.HasTextureCoords(0);
      scene_.uvs.push_back(has_uv ? glm::vec2(mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y)
                                  : glm::vec2(0.0f));
    }
    if (!mesh.HasTextureCoords(0)) scene_.repairs.counts["vertices_without_uv_set_to_0"] += mesh.mNumVertices;
    if (!mesh.HasNormals()) scene_.repairs.counts["vertices_without_normal"] += mesh.mNumVertices;
  }

  void append_faces(const aiMesh& mesh, uint32_t first, uint32_t material, uint32_t object, bool mirrored) {
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) {
        ++scene_.repairs.counts["points_and_lines_left_out"];
        continue;
      }
      for (unsigned k = 0; k < 3; ++k)
        if (face.mIndices[k] >= mesh.mNumVertices)
          fail("{}: mesh '{}', face {}: vertex index {}; the mesh has {} vertices", file_.string(),
               mesh.mName.C_Str(), f, face.mIndices[k], mesh.mNumVertices);
      Triangle triangle{
          {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]}, material, object};
      if (mirrored) std::swap(triangle.v[1], triangle.v[2]);
      scene_.triangles.push_back(triangle);
    }
  }

  const aiScene& source_;
  const std::filesystem::path& file_;
  const MeshFileOptions& options_;
  Scene& scene_;
  AssimpMaterials materials_;
};

}  // namespace

bool has_ending(const std::filesystem::path& file, const std::string& ending) {
  std::string own = file.extension().string();
  for (char& c : own) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return own == ending;
}

bool is_mesh_file_name(const std::filesystem::path& file) {
  for (const char* ending : {".obj", ".gltf", ".glb", ".ply"})
    if (has_ending(file, ending)) return true;
  return false;
}

void append_mesh_file(Scene& scene, const std::filesystem::path& file, const MeshFileOptions& options) {
  if (!is_mesh_file_name(file))
    fail("{}: not a mesh file; valid endings: .obj, .gltf, .glb, .ply", file.string());
  if (!std::filesystem::is_regular_file(file)) fail("{}: no such mesh file", file.string());
  if (has_ending(file, ".ply")) require_complete_ply(file);
  Assimp::Importer importer;
  std::vector<std::string> log;
  const aiScene* source = nullptr;
  {
    const LogCapture capture(log);
    source = importer.ReadFile(file.string(), aiProcess_Triangulate);
  }
  if (!source || !source->mRootNode) fail("{}: {}", file.string(), importer.GetErrorString());
  for (const std::string& line : log)
    scene.repairs.warnings.push_back(fmt::format("{}: {}", file.string(), line));
  const size_t triangles_before = scene.triangles.size();
  MeshAppender(*source, file, options, scene).append_node(*source->mRootNode, options.transform);
  const auto glass = scene.repairs.counts.find("clear_glass_triangles_left_out");
  if (glass != scene.repairs.counts.end())
    scene.repairs.warnings.push_back(
        fmt::format("{}: clear glass is not simulated: light passes straight through ({} triangles left out)",
                    file.string(), glass->second));
  if (scene.triangles.size() == triangles_before)
    fail("{}: the file holds no triangle that can be shown", file.string());
}

}  // namespace relight
