#include "experiments/mitsuba/ply_file.h"

#include <bit>
#include <unordered_map>

#include <fmt/format.h>

#include "common/run/atomic_file.h"

namespace relight::mitsuba {

namespace {

static_assert(std::endian::native == std::endian::little, "the header promises little-endian numbers");

template <typename T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

struct Vertices {
  std::string bytes;
  std::unordered_map<uint32_t, uint32_t> index;  // of scene vertices in the file
};

uint32_t index_of(Vertices& vertices, uint32_t v, const Scene& scene, const MeshPart& part) {
  const auto [entry, added] = vertices.index.try_emplace(v, static_cast<uint32_t>(vertices.index.size()));
  if (added) {
    const glm::vec3& front = scene.normals[v];
    append(vertices.bytes, scene.positions[v] - part.behind * front);
    append(vertices.bytes, part.back ? -front : front);
    append(vertices.bytes, scene.uvs[v]);
  }
  return entry->second;
}

std::string header(size_t vertices, size_t triangles) {
  std::string text = "ply\nformat binary_little_endian 1.0\n";
  text += fmt::format("element vertex {}\n", vertices);
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "u", "v"})
    text += fmt::format("property float {}\n", name);
  text += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", triangles);
  return text;
}

}  // namespace

void write_ply(const std::filesystem::path& file, const Scene& scene, const MeshPart& part) {
  Vertices vertices;
  std::string faces;
  for (const uint32_t t : part.triangles) {
    const uint32_t* v = scene.triangles[t].v;
    append(faces, uint8_t{3});
    for (const int corner : {0, part.back ? 2 : 1, part.back ? 1 : 2})
      append(faces, static_cast<int32_t>(index_of(vertices, v[corner], scene, part)));
  }
  write_text_atomically(file, header(vertices.index.size(), part.triangles.size()) + vertices.bytes + faces);
}

}  // namespace relight::mitsuba
