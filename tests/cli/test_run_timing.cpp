// `relight run`: timing by turns, the time limit, and several processes.
#include <chrono>

#include <gtest/gtest.h>

#include "experiments/run/run_experiment.h"
#include "fake_methods.h"
#include "program.h"
#include "stable_record.h"

namespace relight::test {
namespace {

namespace fs = std::filesystem;

ExperimentResult run(const TemporaryFolder& folder, const MethodList& methods, const std::string& text) {
  write_text(folder / "trial.toml", "title = 'trial'\nview = '12x9'\nreference_samples = 8\n" + text);
  SessionOptions session;
  session.quiet = session.no_cache = true;
  const fs::path out = folder / "out";
  return run_experiment(make_runs(read_experiment(folder / "trial.toml"), session, methods, out), out, false);
}

std::string group(const std::string& method, const std::string& knobs = "") {
  return "[[runs]]\nscenes = ['cornell']\nlights = ['omni']\nmethod = '" + method + "'\n" + knobs;
}

// Red if one run's repeats follow each other: whatever slows the machine down for a while would slow down
// that run alone.
TEST(RunTiming, RepeatsOfTheRunsTakeTurns) {
  TemporaryFolder folder;
  const auto sizes = std::make_shared<std::vector<int64_t>>();
  MethodList methods;
  methods.push_back(make_listening_method(sizes));
  const ExperimentResult result =
      run(folder, methods, "repeats = 3\n" + group("listening", "[runs.knobs]\nsize = [1, 2, 3]\n"));
  const std::vector<int64_t> turns = {1, 2, 3,           // to warm up, once prepared
                                      1, 1, 2, 2, 3, 3,  // each turn begins with one that is not timed
                                      3, 3, 2, 2, 1, 1,  // backwards
                                      1, 1, 2, 2, 3, 3};
  EXPECT_EQ(*sizes, turns);
  ASSERT_EQ(result.records.size(), 3u);
  for (const RunRecord& record : result.records) EXPECT_EQ(record.relight_ms.repeats, 3);
  EXPECT_EQ(result.records[1].knobs.at("size"), "2") << "a record is another run's";
}

// One run alone needs no more relights than before; five repeats in three rounds are five.
TEST(RunTiming, OneRunAloneDoesItsRepeatsAndNoMore) {
  TemporaryFolder folder;
  const auto sizes = std::make_shared<std::vector<int64_t>>();
  MethodList methods;
  methods.push_back(make_listening_method(sizes));
  const ExperimentResult result = run(folder, methods, "repeats = 5\n" + group("listening"));
  EXPECT_EQ(sizes->size(), 6u);
  EXPECT_EQ(result.records.at(0).relight_ms.repeats, 5);
}

// Red if a run over its limit takes its ten seconds, its reason is not told, or the others do not go on.
void expect_ended_early(bool reports_progress) {
  TemporaryFolder folder;
  MethodList methods;
  methods.push_back(make_slow_method(reports_progress));
  methods.push_back(make_ten_percent_method());
  const auto start = std::chrono::steady_clock::now();
  const ExperimentResult result =
      run(folder, methods,
          "repeats = 1\ntime_limit_s = 0.1\n" + group("slow") +
              "[[runs]]\nscenes = ['cornell']\nlights = ['spot']\nmethod = 'ten_percent'\n");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8));
  ASSERT_EQ(result.records.size(), 2u);
  ASSERT_EQ(result.failures.size(), 1u);
  EXPECT_NE(result.failures[0].find("relight: over its time limit of 0.1 s, at 'waiting'"), std::string::npos)
      << result.failures[0];
  EXPECT_TRUE(result.records[1].errors);
}

TEST(RunTiming, ATimeLimitEndsARunThatReportsProgress) { expect_ended_early(true); }

TEST(RunTiming, ATimeLimitEndsARunAtItsStages) { expect_ended_early(false); }

// Red if times of processes that ran at the same time pass for those of one alone, a run is lost, or a
// picture depends on the number of processes.
TEST(RunTiming, SeveralProcessesGiveTheSameRecordsAndSaySo) {
  TemporaryFolder folder;
  write_text(
      folder / "trial.toml",
      "title = 'trial'\nview = '24x18'\nreference_samples = 8\nrepeats = 1\n[[runs]]\nscenes = ['cornell']\n"
      "lights = ['omni', 'spot', 'near']\nmethod = 'path_tracing'\n[runs.knobs]\nsamples = [1, 2]\n");
  const auto run_with = [&](const std::string& out, const std::string& more) {
    const ProgramResult result =
        run_program("run '" + (folder / "trial.toml") + "' --quiet --no-cache --threads 1 --out '" +
                    (folder / out) + "' " + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    auto records = stable_records(folder / out);
    std::sort(records.begin(), records.end());  // whichever process was first
    return records;
  };
  auto alone = run_with("alone", ""), together = run_with("together", "--jobs 2");
  ASSERT_EQ(alone.size(), 6u);
  ASSERT_EQ(together.size(), 6u);
  for (auto& record : together) {
    EXPECT_TRUE(record["provenance"].value("shared_machine", false));
    record["provenance"].erase("shared_machine");
  }
  std::sort(together.begin(), together.end());
  EXPECT_EQ(together, alone);
  expect_same_images(folder / "alone", folder / "together");
  EXPECT_TRUE(fs::exists(folder / "together/table.csv"));
}

}  // namespace
}  // namespace relight::test
