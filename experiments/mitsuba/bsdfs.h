// Materials as Mitsuba BSDFs, one function a model.
#pragma once

#include <filesystem>
#include <string>

#include "common/scene/scene.h"
#include "experiments/mitsuba/xml_writer.h"

namespace relight::mitsuba {

// Reflection models of a Material; a new one needs a name here and a writer in bsdfs.cpp.
enum class Model { diffuse, phong };
Model model_of(const Material& material);

// "material-3".
std::string bsdf_id(size_t material);

// Writes <bsdf id="material-..."> and, for a textured material, the product of its colour and texture to
// folder/textures/. Throws Error naming the file.
void write_bsdf(XmlWriter& xml, const Scene& scene, size_t material, const std::filesystem::path& folder);

}  // namespace relight::mitsuba
