// One process at a time works in an output folder. The lock is the kernel's (flock on FOLDER/.lock): it ends
// with the process, also with one that was killed.
#pragma once

#include <filesystem>

namespace relight {

class FolderLock {
 public:
  // Creates the folder if needed. Throws Error if another process holds the lock, or the file cannot be made.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace relight
