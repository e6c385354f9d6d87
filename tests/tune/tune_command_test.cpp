// `relight tune` and `relight hard-cases` as a person runs them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/cli/program.h"

namespace relight::test {
namespace {

// Red if the tables, the choice's command or the verification are missing.
TEST(TuneCommand, TunesARealMethodOnATinyView) {
  const TemporaryFolder folder;
  const std::string command =
      "tune --scene cornell --lights near --view 24x18 --error 80% --method clustered_gather --runs 4 "
      "--repeats 1 "
      "--set clustered_gather.directions=64 --set clustered_gather.device=cpu --reference-samples 32 "
      "--verify-lights omni --cache " +
      folder / "cache" + " --out " + folder / "out";
  const ProgramResult run = run_program(command);
  EXPECT_TRUE(run.exit_code == 0 || run.exit_code == 1) << run.err;
  EXPECT_NE(run.out.find("Cheapest setting found: clustered_gather"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("relight compare --scene cornell"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("of 1 lightings that the search did not see"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("[2/4] clustered_gather: "), std::string::npos) << run.err;
  const std::string csv = read_text(folder / "out/tune.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 + 1) << csv;
  EXPECT_EQ(read_json_lines(folder / "out/records.jsonl").size(), 5u);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/tune.md"));
  EXPECT_EQ(run_program("tune --scene cornell --error 5% --method nobody --out " + folder / "no").exit_code,
            2);
}

TEST(HardCasesCommand, WritesItsTablesAndRefusesUnknownCases) {
  const TemporaryFolder folder;
  const ProgramResult run =
      run_program("hard-cases --quiet --only 'sparse products: nothing' --out " + folder / "out");
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("1 cases, 0 broken"), std::string::npos) << run.out;
  for (const char* file : {"index.html", "hard_cases.csv", "hard_cases.json", "hard_cases.md"})
    EXPECT_NE(read_text(folder / (std::string("out/") + file)).find("nothing to multiply"), std::string::npos)
        << file;
  EXPECT_EQ(run_program("hard-cases --only nonsense --out " + folder / "no").exit_code, 2);
  EXPECT_NE(run_program("hard-cases --list").out.find("clustered_gather: all gather points equal: "),
            std::string::npos);
}

}  // namespace
}  // namespace relight::test
