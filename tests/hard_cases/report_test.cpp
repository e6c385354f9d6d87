// What the report makes of planted cases: one that holds, one that breaks, one that gives NaN, one that
// throws, one that measures nothing.
#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "experiments/hard_cases/run_hard_cases.h"
#include "experiments/usage_error.h"

namespace relight {
namespace {

using namespace hard;

HardCase planted(const std::string& name, std::function<Figures()> measure) {
  return {"planted", {name, "It is planted.", std::move(measure)}};
}

std::vector<HardCase> planted_cases() {
  return {planted("holds", [] { return Figures{at_most("error", 0.5, 1.0, "half, \"exactly\"")}; }),
          planted("breaks",
                  [] {
                    return Figures{at_most("error", 0.5, 1.0, "a"), at_least("light", 2.0, 3.0, "<b>")};
                  }),
          planted("gives NaN", [] { return Figures{at_least("light", std::nan(""), 0.0, "c")}; }),
          planted("throws", []() -> Figures { throw std::runtime_error("planted | failure"); }),
          planted("measures nothing", [] { return Figures{}; })};
}

TEST(HardCaseReport, OnlyFiguresWithinTheirBoundsHold) {
  const auto outcomes = run_hard_cases(planted_cases(), true);
  ASSERT_EQ(outcomes.size(), 5u);
  EXPECT_TRUE(outcomes[0].holds());
  for (size_t i = 1; i < 5; ++i) EXPECT_FALSE(outcomes[i].holds()) << outcomes[i].name;
  EXPECT_EQ(broken(outcomes), 4);
  EXPECT_EQ(verdict_text(outcomes[3]), "broken: planted | failure");
}

// Red if of two lights the better one is kept, or NaN is dropped.
TEST(HardCaseReport, OfEqualFiguresTheWorstIsKept) {
  Figures figures;
  for (const double value : {1.0, 3.0, 2.0}) add_worst(figures, at_most("error", value, 5.0, ""));
  for (const double value : {4.0, 2.0, 3.0}) add_worst(figures, at_least("light", value, 1.0, ""));
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0].measured, 3.0);
  EXPECT_EQ(figures[1].measured, 2.0);
  add_worst(figures, at_most("error", std::nan(""), 5.0, ""));
  add_worst(figures, at_most("error", 9.0, 5.0, ""));
  EXPECT_TRUE(std::isnan(figures[0].measured));
}

// Red if a broken case is missing from one of the tables, or text is not escaped.
TEST(HardCaseReport, EveryTableShowsEveryCaseAndItsVerdict) {
  const auto outcomes = run_hard_cases(planted_cases(), true);
  const std::string csv = hard_cases_csv(outcomes), md = hard_cases_markdown(outcomes, {}),
                    html = hard_cases_html(outcomes, {}), text = hard_cases_text(outcomes);
  for (const std::string* table : {&csv, &md, &html, &text})
    for (const auto& outcome : outcomes)
      EXPECT_NE(table->find(outcome.name), std::string::npos) << outcome.name;
  EXPECT_NE(csv.find("\"half, \"\"exactly\"\"\""), std::string::npos);
  EXPECT_NE(md.find("planted \\| failure"), std::string::npos);
  EXPECT_NE(html.find("&lt;b&gt;"), std::string::npos);
  EXPECT_NE(html.find("4 broken"), std::string::npos);
  EXPECT_NE(text.find("5 cases, 4 broken"), std::string::npos);
  const auto json = nlohmann::json::parse(hard_cases_json(outcomes, {}));
  EXPECT_EQ(json["broken"], 4);
  EXPECT_EQ(json["cases"][1]["figures"][1]["verdict"], "broken");
  EXPECT_EQ(json["cases"][2]["figures"][0]["measured"], "nan");
}

TEST(HardCaseReport, OnlyChoosesByTitleAndRefusesTextThatNoCaseHas) {
  const auto cases = planted_cases();
  EXPECT_EQ(only(cases, "planted: t").size(), 1u);
  EXPECT_THROW(only(cases, "no such case"), UsageError);
}

}  // namespace
}  // namespace relight
