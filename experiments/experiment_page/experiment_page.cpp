#include "experiments/experiment_page/experiment_page.h"

#include <algorithm>

#include <fmt/format.h>

#include "common/run/atomic_file.h"
#include "common/run/error.h"
#include "experiments/experiment_page/page_parts.h"
#include "experiments/report/html.h"
#include "experiments/report/sections.h"
#include "experiments/run/record_of.h"
#include "experiments/run/run_experiment.h"
#include "experiments/tables/paper_numbers.h"
#include "experiments/tables/sequences.h"

namespace relight {

namespace {

std::string failures(const tables::Results& results, const std::vector<std::string>& left_out) {
  const tables::Table table = tables::failures_table(results);
  std::string html = "<section id=failures><h2>What failed, and why</h2>";
  html += table.rows.empty() ? "<p>Nothing failed.</p>" : page::html(table);
  for (const std::string& sentence : left_out)
    html += fmt::format("<p>Left out: {}</p>", report::escaped(sentence));
  return html + "</section>";
}

// The figures of the papers beside those of table.csv.
std::vector<tables::Table> paper_tables(const std::vector<RunRecord>& records,
                                        const ExperimentDescription& about) {
  std::vector<tables::Table> list;
  // Not from the file: an experiment that was interrupted has none yet.
  const std::vector<tables::CsvRow> rows = tables::csv_rows(result_csv(records), "table.csv");
  for (const std::filesystem::path& file : about.paper_numbers) {
    list.push_back(tables::paper_table(tables::read_paper_numbers(file), rows));
    list.back().name = "paper_" + tables::plain_name(file.stem().string());
  }
  std::erase_if(list, [](const tables::Table& t) { return t.rows.empty(); });
  return list;
}

std::string paper_section(const std::vector<tables::Table>& papers) {
  if (papers.empty()) return "";
  std::string html = "<section id=papers><h2>Beside the paper's figures</h2>";
  for (const tables::Table& table : papers) html += page::html(table);
  return html +
         "<p class=note>Better, worse: beyond the interval of ours and the rounding of the paper's; within: "
         "not. Times of other machines are shown and not judged.</p></section>\n";
}

std::string page_text(const ExperimentDescription& about, const tables::Results& results,
                      const tables::Table& explained, const std::vector<tables::Table>& papers,
                      const std::vector<std::string>& warnings) {
  using namespace page;
  const std::string title = report::escaped(about.title);
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport "
      "content='width=device-width'><title>relight: {0}</title><style>{1}{2}</style></head>\n<body>"
      "<header><h1>{0}</h1><p>Experiment {3} &middot; {4} runs &middot; relighting methods against a "
      "path-traced reference</p></header>\n",
      title, report::style_sheet, page::style_sheet, report::escaped(about.name), results.records.size());
  html += who_wins_section(results) + "\n" + accuracy_section(results) + "\n";
  html += "<section id=all-runs><h2>All runs</h2>" + page::html(tables::runs_table(results)) + "</section>\n";
  if (const tables::Table moving = tables::sequence_table(results); !moving.rows.empty())
    html += "<section id=sequences><h2>Light sequences</h2>" + page::html(moving) + "</section>\n";
  html += explained_section(explained) + paper_section(papers);
  html += failures(results, about.left_out) + "\n" + left_out_section(results, about.left_out) + "\n" +
          provenance_section(results, warnings);
  return html + fmt::format(
                    "\n<div id=tip hidden></div><script type='application/json' id=plot-data>{}</script>"
                    "<script>{}{}</script></body></html>\n",
                    plot_data(results), table_script, plot_script);
}

}  // namespace

std::string write_experiment_page(const std::filesystem::path& folder, RunPages run_pages) {
  const std::filesystem::path file = folder / "records.jsonl";
  if (!std::filesystem::exists(file)) fail("'{}' holds no records.jsonl", folder.string());
  const RecordFile read = read_records(file);
  if (read.records.empty()) fail("'{}' holds no readable record", file.string());
  tables::Results results;
  results.records = latest_of_each(read.records);
  results.groups = tables::make_groups(results.records);
  const std::vector<page::RunFolder> folders = page::write_run_pages(folder, results.records, run_pages);
  for (const page::RunFolder& f : folders) results.links.push_back(f.link);
  const ExperimentDescription about = page::read_description(folder);
  std::vector<std::string> warnings = read.warnings;
  const tables::Table explained = page::explained_table(results, folders, warnings);
  const std::vector<tables::Table> papers = paper_tables(results.records, about);
  std::vector<tables::Table> more = papers;
  if (!explained.rows.empty()) more.insert(more.begin(), explained);
  page::write_table_files(folder, about, results, more);
  write_text_atomically(folder / "index.html", page_text(about, results, explained, papers, warnings));
  return tables::terminal_text(results.groups);
}

}  // namespace relight
