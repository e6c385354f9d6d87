// Lights and environment as Mitsuba emitters.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/scene/scene.h"
#include "experiments/mitsuba/xml_writer.h"

namespace relight::mitsuba {

// Writes the emitter of light number `index`; a spot's falloff goes to folder/textures/ as a picture that
// Mitsuba's spot projects. Adds a sentence to `warnings` for what Mitsuba cannot do.
void write_light(XmlWriter& xml, const Light& light, size_t index, const std::filesystem::path& folder,
                 std::vector<std::string>& warnings);

// Writes nothing for a black environment; a map goes to folder/textures/environment.exr.
void write_environment(XmlWriter& xml, const Environment& environment, const std::filesystem::path& folder);

// What a spot's light is multiplied with at each point of the square that just holds its outer cone,
// projected to a plane across the axis.
Image spot_falloff(const Light& light);

}  // namespace relight::mitsuba
