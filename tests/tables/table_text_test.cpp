// One table as Markdown, LaTeX and JSON.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/tables/table.h"

namespace relight::test {
namespace {

using namespace tables;

Table small() {
  Table table{"small", "Errors at 5 %", {{"method_a", false}, {"≤ error", true}}, {}, "A note."};
  const double none = TableCell{}.value;
  table.rows = {{{"a|b", none, "best", ""}, {"3.27 ± 0.01 %", 3.2704, "", ""}},
                {{"x<y", none, "", ""}, {"-", none, "", ""}}};
  return table;
}

TEST(TableText, MarkdownKeepsItsColumns) {
  EXPECT_EQ(
      markdown(small()),
      "## Errors at 5 %\n\n| method_a | ≤ error |\n|---|---:|\n| **a\\|b** | 3.27 ± 0.01 % |\n| x<y | - |\n"
      "\nA note.\n");
}

// Red if a character that LaTeX reads as a command gets through.
TEST(TableText, LatexEscapesWhatItWouldReadAsCommands) {
  const std::string tex = latex(small());
  EXPECT_NE(tex.find("\\caption{Errors at 5 \\%}"), std::string::npos);
  EXPECT_NE(tex.find("method\\_a & $\\le$ error \\\\"), std::string::npos) << tex;
  EXPECT_NE(tex.find("\\textbf{a$|$b} & 3.27 $\\pm$ 0.01 \\% \\\\"), std::string::npos) << tex;
  EXPECT_NE(tex.find("x$<$y & - \\\\"), std::string::npos);
  EXPECT_NE(tex.find("\\begin{tabular}{lr}"), std::string::npos);
}

// Red if digits are lost, or a cell that has no number gets one.
TEST(TableText, JsonHoldsNumbersWithAllDigits) {
  const auto read = nlohmann::json::parse(json_text(small()));
  EXPECT_EQ(read.at("rows")[0][1].get<double>(), 3.2704);
  EXPECT_EQ(read.at("rows")[0][0], "a|b");
  EXPECT_EQ(read.at("rows")[1][1], "-");
}

}  // namespace
}  // namespace relight::test
