// Meshes as Mitsuba shapes: one PLY file for each object and material.
#pragma once

#include <filesystem>

#include "common/scene/scene.h"
#include "experiments/mitsuba/xml_writer.h"

namespace relight::mitsuba {

struct ShapeCounts {
  int64_t meshes = 0, triangles = 0;  // without the backs of emitters
  int64_t emitter_backs = 0;
};

// Writes folder/meshes/*.ply and the shapes that name them. Emitters of Mitsuba shine from their front only,
// ours from both sides: a shining mesh gets a second one, turned over and a hair behind the first.
ShapeCounts write_shapes(XmlWriter& xml, const Scene& scene, const std::filesystem::path& folder);

}  // namespace relight::mitsuba
