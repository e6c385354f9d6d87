#include "common/run/atomic_file.h"

#include <atomic>
#include <fstream>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

#include "common/run/error.h"

namespace relight {

namespace {

// Unique among processes and threads; keeps the extension, by which image writers choose their format.
std::filesystem::path temporary_name(const std::filesystem::path& file) {
  static std::atomic<int> counter{0};
  const std::string name =
      fmt::format("{}.{}-{}.tmp{}", file.stem().string(), getpid(), counter++, file.extension().string());
  return file.parent_path() / name;
}

void create_parent_folder(const std::filesystem::path& file) {
  if (!file.has_parent_path()) return;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) fail("cannot create folder '{}': {}", file.parent_path().string(), error.message());
}

}  // namespace

void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path& temporary)>& write) {
  create_parent_folder(file);
  const std::filesystem::path temporary = temporary_name(file);
  try {
    write(temporary);
    std::error_code error;
    std::filesystem::rename(temporary, file, error);
    if (error) fail("cannot write '{}': {}", file.string(), error.message());
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void remove_leftovers(const std::filesystem::path& folder) {
  static const std::regex temporary(R"(.+\.\d+-\d+\.tmp(\.[^.]*)?)");
  std::error_code error;
  std::vector<std::filesystem::path> found;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->is_regular_file(error) && std::regex_match(it->path().filename().string(), temporary))
      found.push_back(it->path());
  for (const std::filesystem::path& file : found) std::filesystem::remove(file, error);
}

void write_text_atomically(const std::filesystem::path& file, std::string_view bytes) {
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) fail("cannot write '{}': disk full or no permission", file.string());
  });
}

}  // namespace relight
