#include "experiments/session/folder_lock.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "common/run/error.h"

namespace relight {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::path file = folder / ".lock";
  descriptor_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("cannot write '{}': {}", file.string(), std::strerror(errno));
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int cause = errno;
  close(descriptor_);
  if (cause == EWOULDBLOCK) fail("'{}': another `relight run` is at work in this folder", folder.string());
  fail("cannot lock '{}': {}", file.string(), std::strerror(cause));
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace relight
