// Whole files or nothing: written under a temporary name in the same folder, then renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace relight {

// Calls `write` with a temporary file name (same folder, same extension) and renames the result to `file`,
// replacing an older one. Creates the folder. If `write` throws, or the rename fails, nothing is left behind
// and `file` is unchanged; a failed rename or folder throws Error naming the file.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

// The same for given bytes, text or not. Throws Error naming the file, e.g. on a full disk.
void write_text_atomically(const std::filesystem::path& file, std::string_view bytes);

// Removes what killed processes left under temporary names in `folder` (not in folders below it). Only for
// folders that no other process writes to.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace relight
