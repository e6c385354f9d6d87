// Precomputed data on disk, one file per (kind, key). Files are written to a temporary name and renamed,
// carry a checksum and the full key; a damaged or mismatching file counts as a miss and is replaced.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace relight {

class ArtefactCache {
 public:
  // `enabled` = false: load finds nothing, store does nothing.
  ArtefactCache(std::filesystem::path folder, bool enabled);
  // A cache without files that keeps the last artefact of each kind; copies share what they keep.
  static ArtefactCache in_memory();
  // $RELIGHT_CACHE, else $XDG_CACHE_HOME/relight, else ~/.cache/relight.
  static std::filesystem::path default_folder();

  // `kind` names the artefact ("direct_to_indirect.final_gather"), `key` everything that it depends on, in
  // words.
  std::optional<std::vector<std::byte>> load(const std::string& kind, const std::string& key) const;
  // Throws Error on a full disk or missing permission, leaving no partial file; callers may go on without a
  // cache.
  void store(const std::string& kind, const std::string& key, const std::vector<std::byte>& data) const;

  struct Entry {
    std::filesystem::path file;
    std::string kind, key;
    uintmax_t bytes;
  };
  std::vector<Entry> list() const;
  // Removes every cache file (only files with this cache's header); returns their number.
  int clear() const;
  const std::filesystem::path& folder() const { return folder_; }
  bool enabled() const { return enabled_; }

 private:
  struct Memory;
  std::filesystem::path folder_;
  bool enabled_;
  std::shared_ptr<Memory> memory_;  // null: files
};

}  // namespace relight
