// A check that a PLY file is whole.
#pragma once

#include <filesystem>

namespace relight {

// Walks the elements that the header announces. Throws Error saying which element is missing if the file ends
// early: assimp reads past the end of such a file. Headers it does not understand are left to assimp to
// refuse.
void require_complete_ply(const std::filesystem::path& file);

}  // namespace relight
