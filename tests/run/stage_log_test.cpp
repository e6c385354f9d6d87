#include "common/run/stage_log.h"

#include <thread>

#include <gtest/gtest.h>

namespace relight {
namespace {

// Bug: a repeated stage replaces its time or appears twice; order by name instead of first use.
TEST(StageLog, AddsUpRepeatedStagesInOrderOfFirstUse) {
  StageLog log;
  log.add_seconds("shadow_maps", 1.0);
  log.add_seconds("direct", 2.0);
  log.add_seconds("shadow_maps", 0.5);
  ASSERT_EQ(log.stages().size(), 2u);
  EXPECT_EQ(log.stages()[0], (std::pair<std::string, double>("shadow_maps", 1.5)));
  EXPECT_EQ(log.stages()[1], (std::pair<std::string, double>("direct", 2.0)));
  EXPECT_EQ(log.total_seconds(), 3.5);
}

// Bug: counters replaced instead of added, or bytes of an artefact added instead of replaced.
TEST(StageLog, CountersAddAndBytesReplace) {
  StageLog log;
  log.count("rays", 10), log.count("rays", 5);
  log.bytes("matrix", 100), log.bytes("matrix", 80);
  EXPECT_EQ(log.counters().at("rays"), 15);
  EXPECT_EQ(log.bytes().at("matrix"), 80);
}

// Bug: a CPU clock (stands still while sleeping), or milliseconds logged as seconds.
TEST(StageLog, TimerMeasuresWallTimeInSeconds) {
  StageLog log;
  {
    const StageTimer timer(log, "sleep");
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
  ASSERT_EQ(log.stages().size(), 1u);
  EXPECT_GE(log.total_seconds(), 0.03);
  EXPECT_LT(log.total_seconds(), 10.0);
}

}  // namespace
}  // namespace relight
