#include "experiments/report/report.h"

#include <fmt/format.h>

#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "common/run/run_record.h"
#include "experiments/report/html.h"
#include "experiments/report/sections.h"

namespace relight {

namespace {

std::string page(const RecordFile& file, const std::filesystem::path& folder) {
  using namespace report;
  const Records& records = file.records;
  const RunRecord& first = records.front();
  const std::string title =
      fmt::format("{}, {} lighting, {}", escaped(first.scene), escaped(first.lighting), escaped(first.view));
  return fmt::format(
             "<!doctype html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
             "content='width=device-width'><title>relight: "
             "{}</title><style>{}</style></head>\n<body><header><h1>{}</h1><p>"
             "Relighting methods against a path-traced reference &middot; {} triangles &middot; "
             "{}</p></header>\n",
             title, style_sheet, title, count_text(first.triangles), escaped(first.provenance.date)) +
         results_section(records) + "
" + paths_section(records) + "
" + effects_section(records) + "
" +
         pictures_section(records, folder) + "
" + viewer_section(records, folder) + "
" +
         times_section(records) + "
" + settings_section(records) + "
" +
         origin_section(records, file.warnings) +
         fmt::format("
<div id=large></div><script>{}{}</script></body></html>
", script, viewer_script);
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
  write_text_atomically(folder / "index.html", page(file, folder));
}

}  // namespace relight
