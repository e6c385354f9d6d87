// The folder of an experiment: its page, the pages of its runs, and tables as files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/run/error.h"
#include "page_folder.h"

namespace relight::test {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Red if a part of the page is missing, or it needs a network.
TEST(ExperimentPage, SaysWhoWinsWhatFailedWhatWasLeftOutAndWhereItComesFrom) {
  std::vector<RunRecord> records = planted_methods();
  records[0].not_simulated = {"light from <windows>"};
  const PageFolder folder(records);
  const std::string page = folder.page();
  for (const char* part :
       {"Planted methods, one of them 3 % too dark", "Smallest relative error at equal relight time",
        "3.0 % too dark", "10.0 times slower than exact", "the first at (3, 2)", "moon: not on this machine",
        "light from &lt;windows&gt;", "0123abcd", "a processor, 2 threads", "llvmpipe", "noise floor"})
    EXPECT_TRUE(has(page, part)) << part;
  EXPECT_FALSE(has(page, "<windows>"));
  for (const char* far : {"src='http", "href='http", "src=\"http", "href=\"http", "@import", "url(http"})
    EXPECT_FALSE(has(page, far)) << far;
}

// Red if a run is linked to another's pictures, a name with '%' breaks its address, or a page that is newer
// than its images is made again.
TEST(ExperimentPage, LinksEachRunToAPageWithItsPictures) {
  const std::vector<RunRecord> records = planted_methods();
  const PageFolder folder(records);
  folder.add_images("box_exact_tolerance=1%", records[0]);
  folder.add_images("box_slow", records[3]);
  const std::string page = folder.page();
  EXPECT_TRUE(has(page, "href='box_exact_tolerance=1%25/index.html'"));
  EXPECT_TRUE(has(page, "href='box_slow/index.html'"));
  const fs::path run_page = folder.path / "box_slow/index.html";
  const std::string text = text_of(run_page);
  EXPECT_TRUE(has(text, "id=viewer"));
  EXPECT_TRUE(has(text, "--methods slow"));
  EXPECT_FALSE(has(text, "--methods exact"));
  EXPECT_TRUE(has(text, "href='../index.html'"));
  std::ofstream(run_page) << "kept";
  folder.page();
  EXPECT_EQ(text_of(run_page), "kept");
  folder.page(RunPages::all);
  EXPECT_EQ(text_of(run_page), text);
}

// Red if a run's waterfall is shown as another's, a stage that approximates nothing gets a row, or a broken
// file is passed over in silence or costs the page.
TEST(ExperimentPage, ShowsWhatTheErrorsConsistOf) {
  const std::vector<RunRecord> records = planted_methods();
  const PageFolder folder(records);
  EXPECT_FALSE(has(folder.page(), "What the errors consist of"));
  folder.add_images("box_dark", records[1]);
  folder.add_images("box_slow", records[3]);
  const auto stage = [](const char* name, bool active) {
    return fmt::format(
        R"({{"stage": "{}", "active": {}, "points": {{"relative": 0.0123}}, "half_width": {{"relative": 0.001}},
            "alone_points": {{"relative": null}}, "precompute_saved_s": 4.25, "relight_saved_ms": 7.5}})",
        name, active);
  };
  std::ofstream(folder.path / "box_dark/waterfall.json") << fmt::format(
      R"({{"asked": {{"relative": 0.03}}, "asked_half_width": {{"relative": null}}, "stages": [{}, {}],
          "remainder": {}, "model": {{"share": {{"relative": 0.2}}, "half_width": {{"relative": 0.01}}}}}})",
      stage("pruning", true), stage("rounding", false), stage("grain", true));
  std::ofstream(folder.path / "box_slow/waterfall.json") << "{}";
  const std::string page = folder.page();
  const size_t from = page.find("id=explained");
  ASSERT_NE(from, std::string::npos);
  const std::string section = page.substr(from, page.find("</section>", from) - from);
  for (const char* part : {"What the errors consist of", "box_dark/index.html", "pruning", "1.23", "4.25",
                           "left: grain", "(not simulated)", "20.00"})
    EXPECT_TRUE(has(section, part)) << part;
  EXPECT_FALSE(has(section, "rounding"));
  EXPECT_FALSE(has(section, "box_slow"));
  EXPECT_TRUE(has(page, "box_slow/waterfall.json: not a waterfall"));
  EXPECT_TRUE(has(text_of(folder.path / "tables.md"), "pruning"));
}

TEST(ExperimentPage, LeavesTheTablesAsFiles) {
  const PageFolder folder(planted_methods());
  folder.page();
  const std::string md = text_of(folder.path / "tables.md"), tex = text_of(folder.path / "tables.tex");
  EXPECT_TRUE(has(md, "## box, spot, 64x48: smallest relative error at equal relight time"));
  EXPECT_TRUE(has(md, "3.0 % too dark"));
  EXPECT_TRUE(has(tex, "\\caption{box, spot, 64x48: cheapest relight time at equal relative error}"));
  const auto json = nlohmann::json::parse(text_of(folder.path / "table.json"));
  size_t runs = 0;
  for (const auto& table : json)
    if (table.at("name") == "runs") runs = table.at("rows").size();
  EXPECT_EQ(runs, planted_methods().size());
}

// Red if the page needs more than records: of an interrupted run, of an older version, of failures alone.
TEST(ExperimentPage, IsMadeOfFailuresAloneAndWithoutADescription) {
  const PageFolder folder({planted_failure("a", "out of memory")});
  fs::remove(folder.path / "experiment.json");
  EXPECT_TRUE(has(folder.page(), "out of memory"));
  fs::remove(folder.path / "records.jsonl");
  EXPECT_THROW(folder.page(), Error);
}

TEST(ExperimentFolder, IsToldFromThatOfAComparison) {
  const PageFolder folder(planted_methods());
  EXPECT_TRUE(is_experiment_folder(folder.path));
  // Interrupted: the table is written at the end.
  fs::remove(folder.path / "table.csv");
  EXPECT_TRUE(is_experiment_folder(folder.path));
  EXPECT_TRUE(has(folder.page(), "Experiment"));
  fs::remove(folder.path / "experiment.json");
  EXPECT_FALSE(is_experiment_folder(folder.path));
}

}  // namespace
}  // namespace relight::test
