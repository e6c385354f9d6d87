// Every case of the list that `relight hard-cases` runs: its bounds hold. The cases themselves are in
// common/hard_cases, methods/*/hard_cases and reference/hard_cases.
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "experiments/hard_cases/run_hard_cases.h"

namespace relight {
namespace {

// "a light 1e-4 diagonals from a wall" -> "ALight1e4DiagonalsFromAWall": what GoogleTest accepts.
std::string camel_case(const std::string& text) {
  std::string out;
  bool start = true;
  for (const char c : text) {
    const auto letter = static_cast<unsigned char>(c);
    if (!std::isalnum(letter)) {
      start = start || c == ' ' || c == '_';
      continue;
    }
    out += start ? static_cast<char>(std::toupper(letter)) : c;
    start = false;
  }
  return out;
}

std::string test_name(const HardCase& c) { return camel_case(c.owner) + "_" + camel_case(c.of.name); }

class HardCases : public testing::TestWithParam<HardCase> {};

TEST_P(HardCases, KeepTheirBounds) {
  const HardCaseOutcome outcome = run_hard_case(GetParam());
  EXPECT_EQ(outcome.failure, "");
  EXPECT_FALSE(outcome.figures.empty());
  for (const hard::Figure& f : outcome.figures)
    EXPECT_TRUE(f.holds()) << f.what << ": " << number_text(f.measured) << ", bound " << bound_text(f) << "; "
                           << f.why;
}

INSTANTIATE_TEST_SUITE_P(List, HardCases, testing::ValuesIn(all_hard_cases()),
                         [](const auto& parameter) { return test_name(parameter.param); });

// Red if a list is registered twice, or a case says nothing.
TEST(HardCaseList, NamesEveryCaseOnceAndSaysWhatCouldBreak) {
  std::set<std::string> names;
  for (const HardCase& c : all_hard_cases()) {
    EXPECT_TRUE(names.insert(test_name(c)).second) << title(c);
    EXPECT_FALSE(c.of.breaks.empty()) << title(c);
  }
  EXPECT_GE(names.size(), 25u);
}

}  // namespace

// For GoogleTest's messages.
void PrintTo(const HardCase& c, std::ostream* out) { *out << title(c); }

}  // namespace relight
