#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/run/error.h"
#include "common/run/run_record.h"

namespace relight {

namespace {

// An open file under an exclusive lock, both given back at the end of the scope.
class LockedFile {
 public:
  explicit LockedFile(const std::filesystem::path& file)
      : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0 || flock(descriptor_, LOCK_EX) != 0) {
      const int cause = errno;
      if (descriptor_ >= 0) close(descriptor_);
      fail("cannot open '{}' for appending: {}", file.string(), std::strerror(cause));
    }
  }
  ~LockedFile() { close(descriptor_); }
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;
  int descriptor() const { return descriptor_; }
  off_t size() const {
    struct stat status {};
    return fstat(descriptor_, &status) == 0 ? status.st_size : 0;
  }

 private:
  int descriptor_;
};

bool ends_without_newline(const LockedFile& file) {
  char last = '\n';
  return file.size() > 0 && pread(file.descriptor(), &last, 1, file.size() - 1) == 1 && last != '\n';
}

// Returns whether all was written.
bool write_all(int descriptor, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t n = write(descriptor, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<size_t>(n);
  }
  return true;
}

}  // namespace

void append_record(const std::filesystem::path& file, const RunRecord& record) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  if (error) fail("cannot create folder '{}': {}", file.parent_path().string(), error.message());
  const LockedFile locked(file);
  // A torn last line must not swallow this record.
  std::string line;
  if (ends_without_newline(locked)) line += '\n';
  line += record_to_json(record);
  line += '\n';
  const off_t before = locked.size();
  if (write_all(locked.descriptor(), line)) return;
  const int cause = errno;
  const bool restored = ftruncate(locked.descriptor(), before) == 0;
  fail("cannot append a record to '{}': {}{}", file.string(), std::strerror(cause),
       restored ? "" : "; its last line is torn");
}

RecordFile read_records(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) fail("cannot open '{}' for reading", file.string());
  RecordFile result;
  int line_number = 0;
  for (std::string line; std::getline(in, line);) {
    ++line_number;
    if (line.empty()) continue;
    try {
      result.records.push_back(record_from_json(line));
    } catch (const Error& error) {
      result.warnings.push_back(fmt::format("{}:{}: left out: {}", file.string(), line_number, error.what()));
    }
  }
  return result;
}

}  // namespace relight
