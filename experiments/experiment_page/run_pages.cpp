// The page of each run, and which folder belongs to which record.
#include <cctype>
#include <map>

#include <fmt/format.h>
#include <tbb/parallel_for_each.h>

#include "common/image/exr.h"
#include "common/run/atomic_file.h"
#include "experiments/experiment_page/page_parts.h"
#include "experiments/report/report.h"

namespace relight::page {
namespace {

namespace fs = std::filesystem;

bool is_total(const fs::path& file) {
  const std::string name = file.filename().string(), end = "_total.exr";
  return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

// The picture of a run's folder that carries its command; empty if there is none.
fs::path total_in(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_total(entry.path())) return entry.path();
  return {};
}

// Command -> its total image; of two with one command the newer.
std::map<std::string, fs::path> images_by_command(const fs::path& folder) {
  std::map<std::string, fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory()) continue;
    const fs::path file = total_in(entry.path());
    if (file.empty()) continue;
    const std::string command = read_exr_attribute(file, "relight.command");
    const auto [at, is_new] = images.try_emplace(command, file);
    if (!is_new && fs::last_write_time(file) > fs::last_write_time(at->second)) at->second = file;
  }
  return images;
}

// Names of run folders hold what knobs hold: '%' of a tolerance among others.
std::string as_address(const std::string& path) {
  std::string out;
  for (const char c : path) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                       std::string("-_.~=,+/").find(c) != std::string::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

bool up_to_date(const fs::path& page, const fs::path& image) {
  return fs::exists(page) && fs::last_write_time(page) >= fs::last_write_time(image);
}

}  // namespace

std::vector<RunFolder> write_run_pages(const fs::path& folder, const std::vector<RunRecord>& records,
                                       RunPages run_pages) {
  const std::map<std::string, fs::path> images = images_by_command(folder);
  std::vector<RunFolder> folders(records.size());
  std::map<fs::path, size_t> to_write;  // of two records of one folder the later
  for (size_t i = 0; i < records.size(); ++i) {
    const auto image = images.find(records[i].command);
    if (records[i].command.empty() || image == images.end()) continue;
    const fs::path run_folder = image->second.parent_path(), page = run_folder / "index.html";
    if (run_pages == RunPages::all || !up_to_date(page, image->second)) to_write[run_folder] = i;
    folders[i] = {run_folder, as_address((run_folder.filename() / "index.html").generic_string())};
  }
  // Each takes a second or so, most of it to compress its pictures.
  tbb::parallel_for_each(to_write, [&](const std::pair<const fs::path, size_t>& page) {
    remove_leftovers(page.first);
    write_report(page.first, {records[page.second]}, "../index.html");
  });
  return folders;
}

}  // namespace relight::page
