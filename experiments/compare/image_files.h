// Names and contents of the images that a comparison leaves in its folder; the report finds them by the same
// names.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "common/run/method.h"
#include "reference/path_tracer.h"

namespace relight {

// folder / "<method>_<what>.exr"; what: direct, indirect, total, difference, difference_indirect, reference,
// reference_direct, reference_indirect, reference_variance.
std::filesystem::path image_file(const std::filesystem::path& folder, const std::string& method,
                                 const std::string& what);

// a - b, signed, pixel by pixel (radiance). Both of one size.
Image difference(const Image& a, const Image& b);

// Writes every image of one method's run; metadata goes into each EXR header. Throws Error naming the file.
void write_run_images(const std::filesystem::path& folder, const std::string& method, const Relit& relit,
                      const PathTracerResult& reference, const std::map<std::string, std::string>& metadata);

}  // namespace relight
