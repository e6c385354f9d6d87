#include "experiments/report/report.h"

#include <fmt/format.h>

#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "common/run/run_record.h"
#include "experiments/report/html.h"
#include "experiments/report/sections.h"

namespace relight {

namespace {

std::string page(const report::Records& records, const std::vector<std::string>& unreadable,
                 const std::filesystem::path& folder, const std::string& home) {
  using namespace report;
  const RunRecord& first = records.front();
  const std::string title =
      fmt::format("{}, {} lighting, {}", escaped(first.scene), escaped(first.lighting), escaped(first.view));
  return fmt::format(
             "<!doctype html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
             "content='width=device-width'><title>relight: "
             "{}</title><style>{}</style></head>\n<body><header><h1>{}</h1><p>"
             "Relighting methods against a path-traced reference &middot; {} triangles &middot; "
             "{}{}</p></header>\n",
             title, style_sheet, title, count_text(first.triangles), escaped(first.provenance.date),
             home.empty()
                 ? ""
                 : fmt::format(" &middot; <a href='{}'>all runs of the experiment</a>", escaped(home))) +
         results_section(records) + "\n" + paths_section(records) + "\n" + effects_section(records) + "\n" +
         pictures_section(records, folder) + "\n" + viewer_section(records, folder) + "\n" +
         times_section(records) + "\n" + settings_section(records) + "\n" +
         origin_section(records, unreadable) +
         fmt::format("\n<div id=large></div><script>{}{}</script></body></html>\n", script, viewer_script);
}

}  // namespace

void write_report(const std::filesystem::path& folder) {
  const std::filesystem::path records = folder / "records.jsonl";
  if (!std::filesystem::exists(records)) {
    fail("'{}' holds no records.jsonl: it is not the folder of a comparison", folder.string());
  }
  const RecordFile file = read_records(records);
  if (file.records.empty()) {
    fail("'{}' holds no readable record{}{}", records.string(), file.warnings.empty() ? "" : ": ",
         file.warnings.empty() ? "" : file.warnings.front());
  }
  write_text_atomically(folder / "index.html", page(file.records, file.warnings, folder, ""));
}

void write_report(const std::filesystem::path& folder, const std::vector<RunRecord>& records,
                  const std::string& home) {
  write_text_atomically(folder / "index.html", page(records, {}, folder, home));
}

}  // namespace relight
