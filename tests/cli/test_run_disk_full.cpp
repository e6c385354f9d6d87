// `relight run` when results cannot be written, and after a line of its records was written by half.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "program.h"
#include "stable_record.h"

namespace relight::test {
namespace {

namespace fs = std::filesystem;

const char* const experiment = R"(
title = "Full disk"
view = "48x32"
reference_samples = 16
repeats = 1
[[runs]]
scenes = ["cornell"]
lights = ["omni"]
method = "path_tracing"
[runs.knobs]
samples = [1, 2, 3, 4]
)";

struct Trial {
  TemporaryFolder folder;
  Trial() { write_text(folder / "trial.toml", experiment); }
  ProgramResult run(const std::string& more = "", const std::string& prefix = "") const {
    return run_program(
        fmt::format("run '{}' --quiet --no-cache --out '{}' {}", folder / "trial.toml", folder / "out", more),
        prefix);
  }
  std::string records() const { return folder / "out/records.jsonl"; }
};

void expect_nothing_half_written(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    EXPECT_EQ(entry.path().filename().string().find("tmp"), std::string::npos) << entry.path();
}

// The limit on file size stands for a full disk: both fail in write(). 8 blocks are too little for a picture.
// Red if the other runs are computed for nothing, the message does not name the file, or the record that was
// there is lost.
TEST(RunCommand, AFullDiskEndsItWithTheFileNamedAndNothingLost) {
  const Trial trial;
  ASSERT_EQ(trial.run("--only samples=1").exit_code, 0);
  const std::string before = read_text(trial.records());
  const ProgramResult full = trial.run("", "ulimit -f 8; ");
  EXPECT_EQ(full.exit_code, 1) << full.out;
  EXPECT_NE(full.err.find("cannot write"), std::string::npos) << full.err;
  EXPECT_NE(full.err.find(".exr"), std::string::npos) << full.err;
  EXPECT_NE(full.err.find("are kept"), std::string::npos) << full.err;
  EXPECT_EQ(full.err.find("samples=3"), std::string::npos) << "it went on\n" << full.err;
  EXPECT_EQ(read_text(trial.records()), before);
  expect_nothing_half_written(trial.folder / "out");
  EXPECT_EQ(trial.run().exit_code, 0);
  EXPECT_EQ(stable_records(trial.folder / "out").size(), 4u);
}

// Red if a torn last line stops the experiment, swallows the next record, or its run is not done again. Cut
// in the first field, in the middle, and at the line's end, where the record itself is whole.
TEST(RunCommand, AHalfWrittenLastLineCostsThatRunOnly) {
  const Trial trial;
  ASSERT_EQ(trial.run().exit_code, 0);
  const std::string whole = read_text(trial.records());
  const auto expected = stable_records(trial.folder / "out");
  const size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (const size_t kept : {last + 3, (last + whole.size()) / 2, whole.size() - 1}) {
    write_text(trial.records(), whole.substr(0, kept));
    const ProgramResult resumed = trial.run();
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(stable_records(trial.folder / "out"), expected) << kept;
    const bool torn = kept < whole.size() - 1;
    EXPECT_EQ(resumed.err.find("left out") != std::string::npos, torn) << resumed.err;
  }
}

}  // namespace
}  // namespace relight::test
