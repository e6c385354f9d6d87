// A paper's figures beside ours: intervals, verdicts, matching, and the files of this repository.
#include <gtest/gtest.h>

#include <fstream>

#include "../run/temporary_folder.h"
#include "common/run/error.h"
#include "experiments/tables/paper_numbers.h"

namespace relight::test {
namespace {

using tables::CsvRow;
using tables::PaperFigure;

PaperFigure printed(double low, double high, const std::string& better) {
  PaperFigure figure;
  figure.low = low, figure.high = high, figure.better = better;
  return figure;
}

// 13.6 is anything from 13.55 to 13.65. Red if ours needs to hit the printed digits, or if more is always
// worse.
TEST(PaperVerdict, IsInPlainWords) {
  const PaperFigure error = printed(13.55, 13.65, "smaller"), speed = printed(21.25, 24.95, "larger");
  EXPECT_EQ(tables::verdict(error, 13.56, 0), "within");
  EXPECT_EQ(tables::verdict(error, 13.5, 0), "better");
  EXPECT_EQ(tables::verdict(error, 13.5, 0.06), "within");
  EXPECT_EQ(tables::verdict(error, 14, 0), "worse");
  EXPECT_EQ(tables::verdict(speed, 30, 0), "better");
  EXPECT_EQ(tables::verdict(speed, 20, 0), "worse");
  EXPECT_EQ(tables::verdict(printed(10, 20, "neither"), 30, 0), "more");
  PaperFigure other = error;
  other.of_machine = true;
  EXPECT_EQ(tables::verdict(other, 1, 0), "not comparable: other machine");
  other.not_comparable = "other scene";
  EXPECT_EQ(tables::verdict(other, 1, 0), "not comparable: other scene");
}

TEST(PaperNumbers, StandBesideTheRunsThatTheyName) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "paper.toml";
  std::ofstream(file)
      << "paper = 'A paper'\nmachine = 'old'\n[[groups]]\nwhere = 'table 2'\n"
         "match = { scene = 'sponza' }\nfigures = [ { what = 'gather', printed = '1.1 to 1.2', unit = 'h', "
         "column = 's', factor = 0.5, better = 'smaller', match = { 'm.knob' = '1' } } ]\n";
  const std::vector<CsvRow> runs = tables::csv_rows(
      "scene,m.knob,s,failed\nscenes/"
      "sponza.toml,1,2.2,\nsponza,2,9,\ntemple,1,9,\nsponza,1,,\nsponza,1,9,\"a, b\"\n",
      "t");
  const tables::Table table = tables::paper_table(tables::read_paper_numbers(file), runs);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0][2].text, "sponza, knob=1");
  EXPECT_EQ(table.rows[0][3].text, "1.1 to 1.2");
  EXPECT_DOUBLE_EQ(table.rows[0][4].value, 1.1);
  EXPECT_EQ(table.rows[0][6].text, "within");
}

TEST(PaperNumbers, AreRefusedNamingTheFieldIfTheyAreNoNumbers) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "paper.toml";
  std::ofstream(file)
      << "paper = 'A'\nmachine = 'B'\n[[groups]]\nwhere = 'table 1'\nfigures = [ { what = 'x', printed = "
         "'some', unit = 's', column = 'c', better = 'smaller' } ]\n";
  try {
    tables::read_paper_numbers(file);
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("printed"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("'some'"), std::string::npos) << error.what();
  }
}

TEST(PaperNumbers, OfThisRepositoryCanBeRead) {
  size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(RELIGHT_SOURCE_DIR "/experiments/paper_numbers")) {
    EXPECT_FALSE(tables::read_paper_numbers(entry.path()).figures.empty()) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 3u);
}

}  // namespace
}  // namespace relight::test
