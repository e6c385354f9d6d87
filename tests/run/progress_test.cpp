#include "common/run/progress.h"

#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace relight {
namespace {

// Bug: time left computed as elapsed / share (the total), or percent rounded up to 100 before the end.
TEST(Progress, TellsShareAndTimeLeft) {
  // 42 of 100 in 50.69 s: the other 58 take 70.0 s.
  EXPECT_EQ(format_progress("reference", 42, 100, 50.69), "reference  42 %  1 min 10 s left");
  EXPECT_EQ(format_progress("reference", 999, 1000, 10.0), "reference  99 %  under 1 s left");
}

// Bug: division by zero prints "inf" or "nan" as time left.
TEST(Progress, LeavesTimeOutWhereNothingIsKnown) {
  EXPECT_EQ(format_progress("links", 0, 10, 3.0), "links  0 %");
  EXPECT_EQ(format_progress("links", 7, 0, 3.0), "links  7 done");
}

// Bug: more work than announced reads as 150 % and negative time.
TEST(Progress, NeverExceedsAHundredPercent) {
  EXPECT_EQ(format_progress("links", 15, 10, 3.0), "links  100 %  under 1 s left");
}

// Bug: 59.7 s shown as "59 s" or "60 s", 3600 s as "60 min 0 s"; NaN converted to an integer.
TEST(Progress, DurationsReadWell) {
  EXPECT_EQ(format_duration(0.2), "under 1 s");
  EXPECT_EQ(format_duration(59.4), "59 s");
  EXPECT_EQ(format_duration(59.7), "1 min 0 s");
  EXPECT_EQ(format_duration(3600), "1 h 0 min");
  EXPECT_EQ(format_duration(7500), "2 h 5 min");
  EXPECT_EQ(format_duration(std::numeric_limits<double>::quiet_NaN()), "under 1 s");
  EXPECT_EQ(format_duration(1e300), "years");
}

// Bug: a quiet progress that prints, or one whose printing deadlocks among threads.
TEST(Progress, QuietProgressPrintsNothingFromAnyThread) {
  testing::internal::CaptureStderr();
  Progress progress(true);
  progress.start("work", 4000);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 1000; ++i) progress.advance();
    });
  for (auto& thread : threads) thread.join();
  progress.finish();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// Bug: short work fills a log file with lines; finish() forgets the closing line.
TEST(Progress, ShortWorkLeavesOneLineInALog) {
  testing::internal::CaptureStderr();
  Progress progress;
  progress.start("work", 1000);
  for (int i = 0; i < 1000; ++i) progress.advance();
  progress.finish();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "work  done in under 1 s\n");
}

}  // namespace
}  // namespace relight
