// Binary PLY out: positions, normals, texture coordinates, triangles.
#pragma once

#include <filesystem>
#include <vector>

#include "common/scene/scene.h"

namespace relight::mitsuba {

// Which triangles of a scene, and which of their sides.
struct MeshPart {
  std::vector<uint32_t> triangles;
  bool back = false;    // winding and normals turned over
  float behind = 0.0f;  // moved against the normals of the front by this distance
};

// Writes the part with only the vertices it uses, in the order of their first use. Throws Error naming the
// file.
void write_ply(const std::filesystem::path& file, const Scene& scene, const MeshPart& part);

}  // namespace relight::mitsuba
