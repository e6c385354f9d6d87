#include "experiments/session/output_folder.h"

#include "common/run/atomic_file.h"
#include "experiments/usage_error.h"

namespace relight {

void require_writable_folder(const std::string& option, const std::filesystem::path& folder) {
  if (folder.empty()) usage_fail("{}: the folder's name is empty", option);
  const std::filesystem::path probe = folder / ".relight-probe";
  try {
    write_text_atomically(probe, "probe\n");
    std::filesystem::remove(probe);
  } catch (const std::exception& error) {
    usage_fail("{} '{}' cannot be written: {}", option, folder.string(), error.what());
  }
}

}  // namespace relight
