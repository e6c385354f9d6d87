// Pareto fronts, by hand.
#include <gtest/gtest.h>

#include "experiments/tables/fronts.h"
#include "planted_records.h"

namespace relight::test {
namespace {

using namespace tables;
using Places = std::vector<size_t>;

// (time, error): 0 (10, 5 %), 1 (20, 3 %), 2 (20, 4 %) beaten by 1, 3 (40, 3 %) beaten by 1, 4 (80, 1 %).
std::vector<RunRecord> five() {
  return {planted("a", "0", 0.05, 0, 10, 50), planted("a", "1", 0.03, 0, 20, 40),
          planted("b", "2", 0.04, 0, 20, 30), planted("b", "3", 0.03, 0, 40, 20),
          planted("b", "4", 0.01, 0, 80, 60)};
}

// Red if a point that ties in one number and loses in the other stays, or the order is that of the records.
TEST(ParetoFront, HoldsWhatNobodyBeats) {
  const Group group = group_of(five());
  EXPECT_EQ(pareto_front(group.points, ErrorKind::relative, CostKind::relight), (Places{0, 1, 4}));
  EXPECT_EQ(pareto_front(group.points, ErrorKind::relative, CostKind::memory), (Places{3, 4}));
}

TEST(ParetoFront, OfOneMethodIgnoresTheOthers) {
  const Group group = group_of(five());
  EXPECT_EQ(pareto_front(group.points, ErrorKind::relative, CostKind::relight, "a"), (Places{0, 1}));
  EXPECT_EQ(pareto_front(group.points, ErrorKind::relative, CostKind::relight, "b"), (Places{2, 3, 4}));
  EXPECT_TRUE(pareto_front(group.points, ErrorKind::relative, CostKind::relight, "c").empty());
}

TEST(ParetoFront, KeepsPointsThatAreEqualInBoth) {
  const Group group = group_of({planted("a", "0", 0.05, 0, 10), planted("b", "1", 0.05, 0, 10)});
  EXPECT_EQ(pareto_front(group.points, ErrorKind::relative, CostKind::relight), (Places{0, 1}));
}

// Red if a failed run, which has the best numbers here, enters; or a value that is not known.
TEST(ParetoFront, LeavesOutFailedRunsAndValuesThatAreNotKnown) {
  std::vector<RunRecord> records = five();
  records[4].failed_stages = {"relight: broken"};
  records[0].errors_indirect->value.relative = std::numeric_limits<double>::quiet_NaN();
  const Group group = group_of(records);
  EXPECT_EQ(pareto_front(group.points, ErrorKind::relative, CostKind::relight), (Places{0, 1}));
  EXPECT_EQ(pareto_front(group.points, ErrorKind::indirect, CostKind::relight), (Places{1}));
}

// The front of another error is another front.
TEST(ParetoFront, IsOfTheErrorThatIsAskedFor) {
  std::vector<RunRecord> records{planted("a", "0", 0.02, 0, 10), planted("b", "1", 0.03, 0, 20)};
  records[1].errors->value.relative_edges_out = 0.001;
  const Group group = group_of(records);
  EXPECT_EQ(pareto_front(group.points, ErrorKind::relative, CostKind::relight), (Places{0}));
  EXPECT_EQ(pareto_front(group.points, ErrorKind::edges_out, CostKind::relight), (Places{0, 1}));
}

}  // namespace
}  // namespace relight::test
