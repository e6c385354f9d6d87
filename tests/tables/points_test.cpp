// Which runs stand together, and by which name.
#include <gtest/gtest.h>

#include "experiments/run/record_of.h"
#include "planted_records.h"

namespace relight::test {
namespace {

using namespace tables;

// Red if errors against references of other light paths are put side by side.
TEST(Groups, AreOfOneSceneLightingViewAndSetOfLightPaths) {
  std::vector<RunRecord> records(5, planted("a", "x", 0.05, 0, 10));
  records[1].scene = "ball", records[2].lighting = "omni", records[3].view = "32x24";
  records[4].reference_paths = "E D D D L, 2 bounces, local lights";
  const std::vector<Group> groups = make_groups(records);
  ASSERT_EQ(groups.size(), 5u);
  EXPECT_EQ(groups[1].title(), "ball, spot, 64x48");
  EXPECT_EQ(groups[4].title(), "box, spot, 64x48, E D D D L, 2 bounces, local lights");
}

// Red if a run that failed before it had light paths makes a group of its own, or disappears.
TEST(Groups, KeepRunsThatFailedEarly) {
  RunRecord failed = planted_failure("b", "out of memory");
  failed.reference_paths = "";
  const std::vector<Group> groups = make_groups({failed, planted("a", "x", 0.05, 0, 10)});
  ASSERT_EQ(groups.size(), 1u);
  ASSERT_EQ(groups[0].points.size(), 2u);
  EXPECT_EQ(groups[0].points[1].failure, "out of memory");
  EXPECT_EQ(groups[0].points[1].record, 0u);
}

TEST(Points, HoldValuesIntervalsAndBytesWithoutThePeak) {
  const Group group = group_of({planted("a", "x", 0.05, 0.06, 10, 12, 3)});
  const Point& p = group.points[0];
  EXPECT_DOUBLE_EQ(p[ErrorKind::relative].value, 0.05);
  EXPECT_DOUBLE_EQ(p[ErrorKind::relative].low, 0);  // an error is not negative
  EXPECT_DOUBLE_EQ(p[ErrorKind::relative].high, 0.11);
  EXPECT_DOUBLE_EQ(p[ErrorKind::indirect].value, 0.10);
  EXPECT_DOUBLE_EQ(p[CostKind::relight].high, 11);
  EXPECT_DOUBLE_EQ(p[CostKind::memory].value, 12e6);
  EXPECT_DOUBLE_EQ(p[CostKind::precompute].value, 3);
  EXPECT_DOUBLE_EQ(group.noise_floors[0].value, 0.001);
}

TEST(LatestOfEach, KeepsTheLastRecordOfARunInTheOrderOfTheFirst) {
  std::vector<RunRecord> records{planted_failure("a", "broken"), planted("b", "x", 0.05, 0, 10),
                                 planted("a", "paper", 0.04, 0, 10)};
  const std::vector<RunRecord> latest = latest_of_each(records);
  ASSERT_EQ(latest.size(), 2u);
  EXPECT_EQ(latest[0].method, "a");
  EXPECT_TRUE(latest[0].failed_stages.empty());
}

// A sweep of size at one depth and one run of another depth: size is told everywhere, depth where it is not
// what most runs have.
TEST(Labels, TellWhatIsNotTheSameForMostRuns) {
  std::vector<RunRecord> records(4, planted("a", "paper", 0.05, 0, 10));
  for (size_t i = 0; i < records.size(); ++i)
    records[i].knobs = {{"size", std::to_string(i + 1)}, {"depth", "7"}, {"same", "1"}};
  records[3].knobs["depth"] = "8";
  records.push_back(planted("b", "best", 0.05, 0, 10));
  const std::vector<std::string> names = labels(records);
  EXPECT_EQ(names[0], "paper size=1");
  EXPECT_EQ(names[3], "paper depth=8 size=4");
  EXPECT_EQ(names[4], "best");
  // Two that nothing else tells apart.
  records.push_back(records.back());
  records.back().provenance.date = "2026-02-02";
  EXPECT_EQ(labels(records)[5], "best of 2026-02-02");
  records[0].seed = 2;
  EXPECT_EQ(labels(records)[0], "paper size=1 seed=2");
}

TEST(Numbers, AreWrittenWithThreeDigitsAndTheirUnit) {
  EXPECT_EQ(cost_text(CostKind::relight, 12.345), "12.3 ms");
  EXPECT_EQ(cost_text(CostKind::relight, 1500), "1.50 s");
  EXPECT_EQ(cost_text(CostKind::memory, 58.24e6), "58.2 MB");
  EXPECT_EQ(cost_text(CostKind::memory, 0), "0");
  EXPECT_EQ(cost_text(CostKind::precompute, 0.002), "2.00 ms");
  EXPECT_EQ(cost_text(CostKind::precompute, std::numeric_limits<double>::quiet_NaN()), "-");
  EXPECT_EQ(error_text(Measured{0.0327, 0.0317, 0.0337}), "3.27 ± 0.10 %");
  EXPECT_EQ(error_text(Measured{0.0327, 0.0327, 0.0327}), "3.27 %");
}

}  // namespace
}  // namespace relight::test
