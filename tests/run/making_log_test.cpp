// What it took to make an artefact, kept beside it.
#include "common/run/making_log.h"

#include <gtest/gtest.h>

namespace relight {
namespace {

StageLog example() {
  StageLog log;
  log.add_seconds("rays", 2.0);
  log.add_seconds("tree", 1.0);
  log.count("rays", 100);
  log.bytes("matrix", 7);
  log.warn("one");
  return log;
}

// Bug: what was logged before the artefact was made is counted twice, or a stage that both have is lost.
TEST(MakingLog, DifferenceHoldsWhatWasAdded) {
  const StageLog before = example();
  StageLog after = before;
  after.add_seconds("tree", 0.5), after.add_seconds("links", 4.0);
  after.count("rays", 11), after.count("links", 0);
  after.bytes("links", 3);
  after.warn("two");
  const StageLog added = difference(after, before);
  using Stages = std::vector<std::pair<std::string, double>>;
  EXPECT_EQ(added.stages(), (Stages{{"tree", 0.5}, {"links", 4.0}}));
  EXPECT_EQ(added.counters(), (std::map<std::string, int64_t>{{"links", 0}, {"rays", 11}}));
  EXPECT_EQ(added.bytes(), (std::map<std::string, int64_t>{{"links", 3}}));
  EXPECT_EQ(added.warnings(), std::vector<std::string>{"two"});
}

// Bug: a field is not written, or the seconds are not known as spent earlier.
TEST(MakingLog, BytesGiveTheSameLog) {
  const auto back = making_log_from_bytes(to_bytes(MakingLog{example(), 3.25}));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->seconds, 3.25);
  EXPECT_EQ(back->log.restored_seconds(), 3.25);
  EXPECT_EQ(back->log.stages(), example().stages());
  EXPECT_EQ(back->log.counters(), example().counters());
  EXPECT_EQ(back->log.bytes(), example().bytes());
  EXPECT_EQ(back->log.warnings(), example().warnings());
  EXPECT_FALSE(making_log_from_bytes({std::byte{'{'}}));
}

}  // namespace
}  // namespace relight
