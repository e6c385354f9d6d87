// A method that is planted wrong is told to be so.
#include <gtest/gtest.h>

#include "experiments/tables/make_tables.h"
#include "experiments/tables/remarks.h"
#include "planted_records.h"

namespace relight::test {
namespace {

using namespace tables;

std::string remarks_of(const std::vector<RunRecord>& records, const std::string& method) {
  const Group group = group_of(records);
  std::string text;
  for (const Point& p : group.points)
    if (p.method == method)
      for (const std::string& r : remarks(p, records[p.record], group)) text += r + "|";
  return text;
}

TEST(Remarks, NameAPictureThatIsThreePercentTooDark) {
  EXPECT_NE(remarks_of(planted_methods(), "too_dark").find("3.0 % too dark"), std::string::npos);
  std::vector<RunRecord> bright = planted_methods();
  bright[1].errors->value.bias = 0.03;
  EXPECT_NE(remarks_of(bright, "too_dark").find("3.0 % too bright"), std::string::npos);
  // What the reference's noise explains is not told.
  bright[1].errors->half_width.bias = 0.025;
  EXPECT_EQ(remarks_of(bright, "too_dark").find("too bright"), std::string::npos);
}

TEST(Remarks, NameAMethodThatLeaksNotANumber) {
  const std::string text = remarks_of(planted_methods(), "leaks_nan");
  EXPECT_NE(text.find("FAILED: total image: 1 pixels are not finite, the first at (3, 2)"), std::string::npos)
      << text;
}

// 10 ms and 100 ms at the same error. Red if a more exact run may be called slow for what is less exact.
TEST(Remarks, NameAMethodThatIsTenTimesSlower) {
  const std::string text = remarks_of(planted_methods(), "slow");
  EXPECT_NE(text.find("10.0 times slower than exact paper, which is no less exact"), std::string::npos)
      << text;
  EXPECT_EQ(remarks_of(planted_methods(), "exact").find("slower"), std::string::npos);
  std::vector<RunRecord> better = planted_methods();
  better[3].errors->value.relative = 0.007;
  EXPECT_EQ(remarks_of(better, "slow").find("slower"), std::string::npos);
}

TEST(Remarks, NameAnErrorThatIsNoiseAlone) {
  EXPECT_NE(remarks_of({planted("a", "x", 0.002, 0.001, 10)}, "a").find("noise"), std::string::npos);
  EXPECT_EQ(remarks_of({planted("a", "x", 0.003, 0.001, 10)}, "a").find("noise"), std::string::npos);
}

// Red if a planted method could pass: the table of all runs names all three, none of them wins anywhere.
TEST(PlantedMethods, AreShownAsSuchByTheTables) {
  Results results{planted_methods(), {}, {}};
  results.groups = make_groups(results.records);
  const std::string runs = markdown(runs_table(results));
  for (const char* words :
       {"3.0 % too dark", "FAILED: total image: 1 pixels are not finite", "10.0 times slower than exact"})
    EXPECT_NE(runs.find(words), std::string::npos) << words;
  const std::string failures = markdown(failures_table(results));
  EXPECT_NE(failures.find("leaks_nan"), std::string::npos);
  for (const Table& table :
       {equal_cost_table(results, results.groups[0], ErrorKind::relative, CostKind::relight),
        equal_error_table(results, results.groups[0], ErrorKind::relative, CostKind::relight)})
    for (const auto& row : table.rows)
      for (const char* wrong : {"too_dark", "leaks_nan", "slow"}) {
        EXPECT_NE(row.back().text, wrong);
        EXPECT_NE(row.back().text, std::string("only ") + wrong);
      }
  const std::string at_time =
      markdown(equal_cost_table(results, results.groups[0], ErrorKind::relative, CostKind::relight));
  EXPECT_NE(at_time.find("failed or not run"), std::string::npos);
}

}  // namespace
}  // namespace relight::test
