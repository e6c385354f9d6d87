// Light sequences taken together.
#include <gtest/gtest.h>

#include "experiments/tables/sequences.h"
#include "planted_records.h"

namespace relight::test {
namespace {

using namespace tables;

RunRecord moment(const std::string& lighting, double error, double ms, const std::string& method = "a") {
  RunRecord record = planted(method, "x", error, 0, ms);
  record.lighting = lighting;
  return record;
}

Results results_of(std::vector<RunRecord> records) {
  Results results;
  results.groups = make_groups(records);
  results.records = std::move(records);
  return results;
}

// Red if moments are sorted as text (10 before 2), lightings or methods mix, a lighting that stands still or
// a failed run counts, or the mean is taken of something else than the moments.
TEST(Sequences, TakeTheMomentsOfOneLightingTogether) {
  RunRecord failed = planted_failure("a", "out of memory");
  failed.lighting = "sweep@3";
  const Results results =
      results_of({moment("sweep@10", 0.03, 40), moment("sweep@2", 0.06, 10), moment("sweep@0", 0.03, 10),
                  failed, moment("spot", 0.5, 1), moment("other@0", 0.5, 1), moment("sweep@0", 0.5, 1, "b")});
  const std::vector<Sequence> all = sequences(results.groups);
  ASSERT_EQ(all.size(), 1u);
  const Sequence& s = all.front();
  EXPECT_EQ(s.lighting, "sweep");
  EXPECT_EQ(s.method, "a");
  EXPECT_EQ(s.times, (std::vector<double>{0, 2, 10}));
  EXPECT_NEAR(s.mean(ErrorKind::relative), 0.04, 1e-12);
  EXPECT_EQ(s.worst(ErrorKind::relative), 1u);
  const std::string text = markdown(sequence_table(results));
  EXPECT_NE(text.find("6.00 % at 2 s"), std::string::npos) << text;
  EXPECT_NE(text.find("20.0 ms"), std::string::npos) << text;
  EXPECT_NE(text.find("40.0 ms"), std::string::npos) << text;
}

}  // namespace
}  // namespace relight::test
