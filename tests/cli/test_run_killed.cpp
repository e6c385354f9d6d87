// `relight run`, killed by SIGKILL at random moments and started again, against a run that nobody disturbed.
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "program.h"
#include "stable_record.h"

namespace relight::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Precomputed data that two runs share, data of their own, and none; a reference for each lighting.
const char* const experiment = R"(
title = "Killed"
view = "48x32"
reference_samples = 16
repeats = 1
[[runs]]
scenes = ["cornell"]
lights = ["omni", "spot"]
method = "path_tracing"
[runs.knobs]
samples = [2, 4]
[[runs]]
scenes = ["cornell"]
lights = ["omni", "spot"]
method = "direct_to_indirect"
[runs.knobs]
gather_samples = 1024
device = "cpu"
cull_epsilon = [-1, 0]
[[runs]]
scenes = ["cornell"]
lights = ["omni", "spot"]
method = "clustered_gather"
[runs.knobs]
directions = 64
gather_clusters = 8
view_clusters = [64, 128]
neighbours = 4
)";
constexpr size_t runs = 12;
constexpr int kills = 10;

std::vector<std::string> arguments(const fs::path& file, const fs::path& out) {
  return {"run", file.string(), "--quiet", "--out", out.string(), "--cache", out.string() + ".cache"};
}

// Red if the process is killed by itself, or by anything but this test.
bool ended_well(int status) { return WIFEXITED(status) && WEXITSTATUS(status) == 0; }

double run_undisturbed(const fs::path& file, const fs::path& out) {
  const auto start = Clock::now();
  int status = 0;
  waitpid(start_program(arguments(file, out)), &status, 0);
  EXPECT_TRUE(ended_well(status));
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// True if it was killed; false if it came to its end first.
bool run_and_kill(const fs::path& file, const fs::path& out, double after_s) {
  const auto moment = Clock::now() + std::chrono::duration<double>(after_s);
  const pid_t child = start_program(arguments(file, out));
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (Clock::now() >= moment) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const bool killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  EXPECT_TRUE(killed || ended_well(status));
  return killed;
}

void expect_same_results(const fs::path& whole, const fs::path& killed) {
  const auto expected = stable_records(whole), found = stable_records(killed);
  ASSERT_EQ(expected.size(), runs);
  ASSERT_EQ(found.size(), runs) << "a run was lost or done twice";
  for (size_t i = 0; i < runs; ++i) EXPECT_EQ(found[i], expected[i]);
  expect_same_images(whole, killed);
  EXPECT_TRUE(fs::exists(killed / "table.csv"));
  for (const auto& entry : fs::recursive_directory_iterator(killed))
    EXPECT_EQ(entry.path().filename().string().find("tmp"), std::string::npos) << entry.path();
}

// Whenever an experiment gets to its end before ten kills, the next one starts in an empty folder. Red if a
// record is written before its images, what a killed process had cached changes a counter, a run is lost or
// repeated, or half-written files stay.
TEST(RunCommand, KilledTenTimesAtRandomMomentsEndsWithTheSameRecords) {
  TemporaryFolder folder;
  const fs::path file = folder.path() / "killed.toml", whole = folder.path() / "whole";
  write_text(file, experiment);
  const double seconds = run_undisturbed(file, whole);
  std::mt19937 random(20061);
  std::uniform_real_distribution<double> share(0.05, 0.7);
  std::vector<fs::path> finished;
  for (int killed = 0; killed < kills;) {
    const fs::path out = folder.path() / fmt::format("killed{}", finished.size());
    if (run_and_kill(file, out, share(random) * seconds))
      ++killed;
    else
      finished.push_back(out);
    ASSERT_LT(finished.size(), 20u) << "it ends before it can be killed";
  }
  finished.push_back(folder.path() / fmt::format("killed{}", finished.size()));
  run_undisturbed(file, finished.back());
  for (const fs::path& out : finished) expect_same_results(whole, out);
}

// Red if two processes write to one folder at a time.
TEST(RunCommand, RefusesAFolderThatAnotherRunWorksIn) {
  TemporaryFolder folder;
  const fs::path file = folder.path() / "locked.toml", out = folder.path() / "out";
  write_text(file, experiment);
  const pid_t child = start_program(arguments(file, out));
  const auto late = Clock::now() + std::chrono::seconds(30);
  while (!fs::exists(out / ".lock") && Clock::now() < late)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const ProgramResult second = run_program("run '" + file.string() + "' --out '" + out.string() + "'");
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_NE(second.err.find("another `relight run` is at work"), std::string::npos) << second.err;
}

}  // namespace
}  // namespace relight::test
