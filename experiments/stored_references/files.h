// One folder a stored reference: direct.exr, indirect.exr, variance.exr (of the mean of indirect),
// tile_variance.exr (of the means of 4x4 pixels) and reference.json.
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "experiments/stored_references/picture_statistics.h"

namespace relight {

struct StoredPicture {
  PictureStatistics picture;
  nlohmann::ordered_json identity;    // see picture_identity()
  nlohmann::ordered_json provenance;  // commit, compiler and date
};

// Means keep 16 bits of mantissa (an error of 8e-6, far below any noise here) and variances 8, which makes
// the files small. An old JSON file is removed first and the new one written last: a folder with one is
// complete.
void save_stored(const std::filesystem::path& folder, const PictureStatistics& picture,
                 const nlohmann::ordered_json& identity);

// Throws Error naming the file if one is missing, damaged or of another size.
StoredPicture load_stored(const std::filesystem::path& folder);

bool is_stored(const std::filesystem::path& folder);

}  // namespace relight
