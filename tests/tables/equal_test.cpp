// Tables at equal cost and at equal error, winners and ties, by hand.
#include <gtest/gtest.h>

#include "equal_words.h"
#include "experiments/tables/equal.h"
#include "experiments/tables/winners.h"
#include "planted_records.h"

namespace relight::test {
namespace {

using namespace tables;
using Kind = Verdict::Kind;

// a: 10 % in 10 ms, 2 % in 100 ms; b: 5 % in 40 ms; all +- 0.5 %.
Group two_methods() {
  return group_of({planted("a", "fast", 0.10, 0.005, 10), planted("a", "good", 0.02, 0.005, 100),
                   planted("b", "only", 0.05, 0.005, 40)});
}

// Red if the limit is compared with the largest repeat, or the fastest run is taken instead of the best.
TEST(AtEqualTime, TakesTheBestRunOfEachMethodWithinTheLimit) {
  const Group group = two_methods();
  const LimitRow none = row_at_cost(group, ErrorKind::relative, CostKind::relight, 5);
  EXPECT_EQ(none.verdict.kind, Kind::nobody);
  const LimitRow only_a = row_at_cost(group, ErrorKind::relative, CostKind::relight, 10);
  EXPECT_EQ(only_a.verdict.words(), "only a");
  EXPECT_EQ(*only_a.cells[0].point, 0u);
  EXPECT_EQ(only_a.cells[1].place, Cell::Place::outside);
  const LimitRow b = row_at_cost(group, ErrorKind::relative, CostKind::relight, 99);
  EXPECT_EQ(b.verdict.words(), "b");
  EXPECT_EQ(*b.cells[0].point, 0u);
  const LimitRow a = row_at_cost(group, ErrorKind::relative, CostKind::relight, 100);
  EXPECT_EQ(a.verdict.words(), "a");
  EXPECT_EQ(*a.cells[0].point, 1u);
}

// 5.0 +- 0.5 against 5.9 +- 0.5: the intervals share 5.4 to 5.5. Red if values alone decide.
TEST(AtEqualTime, IsATieWhereIntervalsOverlap) {
  const auto verdict = [](double other) {
    const Group group = group_of({planted("a", "x", 0.05, 0.005, 10), planted("b", "x", other, 0.005, 10)});
    return row_at_cost(group, ErrorKind::relative, CostKind::relight, 10).verdict.words();
  };
  EXPECT_EQ(verdict(0.059), "tie: a, b");
  EXPECT_EQ(verdict(0.061), "a");
  EXPECT_EQ(verdict(0.041), "tie: b, a");
  EXPECT_EQ(verdict(0.039), "b");
}

// Red if a failed run stands for its method.
TEST(AtEqualTime, NeverShowsAFailedRun) {
  RunRecord failed = planted("b", "x", 0.001, 0, 1);
  failed.failed_stages = {"relight: broken"};
  const Group group = group_of({planted("a", "x", 0.05, 0.005, 10), failed});
  const LimitRow row = row_at_cost(group, ErrorKind::relative, CostKind::relight, 1000);
  EXPECT_EQ(row.verdict.words(), "only a");
  EXPECT_FALSE(row.cells[1].point.has_value());
}

// Limits 1 and 3 times powers of ten over 10 .. 100 ms; 10: only a, 100: a. At 30 nothing changes: no row.
TEST(AtEqualTime, HasOneRowForEachRoundLimitThatChangesSomething) {
  const LimitTable table = at_equal_cost(two_methods(), ErrorKind::relative, CostKind::relight);
  EXPECT_EQ(words_of(table), "10: only a; 100: a");
}

// Memory: a keeps nothing, b 50 MB. Below b's only a; red if what costs nothing is left out of the limits.
TEST(AtEqualMemory, BeginsWithWhatKeepsNothing) {
  const Group group =
      group_of({planted("a", "x", 0.05, 0.001, 10, 0), planted("b", "x", 0.01, 0.001, 10, 50)});
  EXPECT_EQ(words_of(at_equal_cost(group, ErrorKind::relative, CostKind::memory)),
            "30000000: only a; 100000000: b");
  const Group nothing = group_of({planted("a", "x", 0.05, 0.001, 10, 0)});
  EXPECT_TRUE(at_equal_cost(nothing, ErrorKind::relative, CostKind::memory).rows.empty());
}

// 5 % is reached by 4.5 +- 0.5, not for certain by 4.6 +- 0.5. Red if the value alone counts.
TEST(AtEqualError, CountsTheUpperEndOfTheInterval) {
  const auto place = [](double error) {
    return row_at_error(group_of({planted("a", "x", error, 0.005, 10)}), ErrorKind::relative,
                        CostKind::relight, 0.0501)
        .cells[0]
        .place;
  };
  EXPECT_EQ(place(0.045), Cell::Place::within);
  EXPECT_EQ(place(0.046), Cell::Place::perhaps);
  EXPECT_EQ(place(0.056), Cell::Place::outside);
}

TEST(AtEqualError, TakesTheCheapestRunThatReachesIt) {
  const Group group = two_methods();
  const LimitRow loose = row_at_error(group, ErrorKind::relative, CostKind::relight, 0.2);
  EXPECT_EQ(loose.verdict.words(), "a");  // 10 ms against 40
  EXPECT_EQ(*loose.cells[0].point, 0u);
  const LimitRow middle = row_at_error(group, ErrorKind::relative, CostKind::relight, 0.06);
  EXPECT_EQ(middle.verdict.words(), "b");  // 100 ms against 40
  const LimitRow sharp = row_at_error(group, ErrorKind::relative, CostKind::relight, 0.03);
  EXPECT_EQ(sharp.verdict.words(), "only a");
  EXPECT_EQ(*sharp.cells[1].point, 2u);  // what b reaches at best
  EXPECT_EQ(row_at_error(group, ErrorKind::relative, CostKind::relight, 0.01).verdict.words(), "nobody");
}

// Repeats from 9 to 11 ms against 10.8 to 13.2: a tie; against 13.5 to 16.5: none.
TEST(AtEqualError, IsATieWhereRepeatsOverlap) {
  const auto verdict = [](double ms) {
    const Group group = group_of({planted("a", "x", 0.05, 0, 10), planted("b", "x", 0.05, 0, ms)});
    return row_at_error(group, ErrorKind::relative, CostKind::relight, 0.1).verdict.words();
  };
  EXPECT_EQ(verdict(12), "tie: a, b");
  EXPECT_EQ(verdict(15), "a");
}

// b is faster and may reach 5 %: a cannot be said to be the cheapest. Red if what is uncertain is ignored.
TEST(AtEqualError, IsNotWonAgainstAFasterRunThatMayReachIt) {
  const Group faster = group_of({planted("a", "x", 0.04, 0.001, 100), planted("b", "x", 0.05, 0.005, 10)});
  EXPECT_EQ(row_at_error(faster, ErrorKind::relative, CostKind::relight, 0.05).verdict.words(), "tie: a, b");
  const Group slower = group_of({planted("a", "x", 0.04, 0.001, 100), planted("b", "x", 0.05, 0.005, 1000)});
  EXPECT_EQ(row_at_error(slower, ErrorKind::relative, CostKind::relight, 0.05).verdict.words(), "a");
}

TEST(WhoWins, IsToldFromTheTableAtEqualTime) {
  const std::vector<std::string> sentences = who_wins({two_methods()});
  ASSERT_EQ(sentences.size(), 2u);
  EXPECT_EQ(sentences[0],
            "Smallest relative error at equal relight time, in 1 comparisons of two or more methods: a 1.");
  EXPECT_EQ(sentences[1],
            "box, spot, 64x48: within 10.0 ms only a; within 100 ms or more a (2.00 % against 5.00 % of b).");
}

}  // namespace
}  // namespace relight::test
