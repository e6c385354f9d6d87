// The Python script that goes with an exported scene.
#pragma once

#include <string>

namespace relight::mitsuba {

// render.py: registers the normalised Phong model, which Mitsuba 3 lacks, renders scene.xml and writes EXR.
const std::string& render_script();

}  // namespace relight::mitsuba
