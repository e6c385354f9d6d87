// `relight explain-error` as a person runs it.
#include <sstream>

#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace relight::test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '"')
      cells.back() += c;
  }
  return cells;
}

// Red if a column is left out of a kind of line, points do not add up as written, or the machine is not
// named.
TEST(ExplainErrorCommand, WritesATableWhosePointsAddUpAndSaysWhereItWasMade) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(
      "explain-error --scene cornell --lights near --view 32x24 --method direct_to_indirect --quiet --set "
      "direct_to_indirect.gather_samples=1024 --pixels 16 --reference-samples 64 --repeats 1 --out " +
      (folder / "out"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("truncation"), std::string::npos);
  EXPECT_NE(result.out.find("not active"), std::string::npos);

  const auto lines = lines_of(read_text(folder / "out/waterfall.csv"));
  ASSERT_GT(lines.size(), 5u);
  const auto header = cells_of(lines[0]);
  const auto points =
      static_cast<size_t>(std::find(header.begin(), header.end(), "points_relative") - header.begin());
  double sum = 0.0, asked = 0.0;
  for (size_t i = 1; i < lines.size(); ++i) {
    const auto cells = cells_of(lines[i]);
    ASSERT_EQ(cells.size(), header.size()) << lines[i];
    if (cells[0] == "model") continue;
    (cells[0] == "total" ? asked : sum) += std::stod(cells[points]);
  }
  EXPECT_GT(asked, 0.1);
  EXPECT_NEAR(sum, asked, 1e-4 * asked);  // six digits are written

  const auto json = nlohmann::json::parse(read_text(folder / "out/waterfall.json"));
  EXPECT_NEAR(json.at("asked").at("relative").get<double>(), 0.01 * asked, 1e-6);
  EXPECT_FALSE(json.at("run").at("provenance").at("cpu").get<std::string>().empty());
  EXPECT_NE(json.at("run").at("command").get<std::string>().find("--pixels 16"), std::string::npos);
}

TEST(ExplainErrorCommand, HelpTeachesAndMistakesAreNamed) {
  EXPECT_NE(run_program("explain-error --help").out.find("add up to the error"), std::string::npos);
  const ProgramResult wrong =
      run_program("explain-error --scene cornell --method direct_to_indirect --block 3x3 --out x");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("multiples of 4"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace relight::test
