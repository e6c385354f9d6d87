// Materials as Mitsuba BSDFs, one function a model.
#pragma once

#include <filesystem>
#include <string>

#include "common/scene/scene.h"
#include "experiments/mitsuba/xml_writer.h"

namespace relight::mitsuba {

// Throws Error naming the first material whose reflection model has no writer in bsdfs.cpp, and those that
// have.
void require_known_models(const Scene& scene);

// "material-3".
std::string bsdf_id(size_t material);

// Writes <bsdf id="material-..."> and, for a textured material, the product of its colour and texture to
// folder/textures/. Throws Error naming the file.
void write_bsdf(XmlWriter& xml, const Scene& scene, size_t material, const std::filesystem::path& folder);

}  // namespace relight::mitsuba
