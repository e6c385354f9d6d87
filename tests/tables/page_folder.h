// The folder of an experiment with planted records, and its page.
#pragma once

#include <fstream>
#include <sstream>

#include "../run/temporary_folder.h"
#include "common/image/exr.h"
#include "experiments/compare/image_files.h"
#include "experiments/experiment_page/experiment_page.h"
#include "planted_records.h"

namespace relight::test {

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

struct PageFolder {
  TemporaryFolder temporary;
  std::filesystem::path path = temporary.path();

  explicit PageFolder(const std::vector<RunRecord>& records) {
    for (const RunRecord& r : records) append_record(path / "records.jsonl", r);
    std::ofstream(path / "table.csv") << "scene\n";
    write_description(
        path, {"planted", "Planted methods, one of them 3 % too dark", {"moon: not on this machine"}, {}});
  }
  // The images of a run, 4x3, in a folder of that name.
  void add_images(const std::string& name, const RunRecord& r) const {
    for (const char* what : {"total", "reference", "indirect", "reference_indirect"})
      write_exr(image_file(path / name, r.method, what), Image(4, 3, glm::vec3(0.25f)),
                {{"relight.command", r.command}});
  }
  std::string page(RunPages pages = RunPages::missing) const {
    write_experiment_page(path, pages);
    return text_of(path / "index.html");
  }
};

}  // namespace relight::test
