// `relight reference`, killed by SIGKILL in the middle and gone on with, against a run that nobody disturbed.
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "common/image/exr.h"

#include "program.h"

namespace relight::test {
namespace {

namespace fs = std::filesystem;

// Layers, so that every kind of EXR file and all of the state are there; from 128 samples on the first look
// that plans paths is part of the state. 48 batches.
std::vector<std::string> arguments(const fs::path& out, int samples = 384) {
  return {"reference",
          "--scene",
          "cornell",
          "--lights",
          "omni",
          "--view",
          "48x36",
          "--quiet",
          "--layers",
          "--class-bounces",
          "1",
          "--samples",
          std::to_string(samples),
          "--checkpoint-seconds",
          "0",
          "--out",
          out.string()};
}

// Of the file that is there now; a new checkpoint is a new file under the same name.
std::optional<ino_t> number_of(const fs::path& file) {
  struct stat info {};
  return stat(file.c_str(), &info) == 0 ? std::optional(info.st_ino) : std::nullopt;
}

// Starts the run and kills it as soon as `checkpoints` new checkpoints have been written. False if it ended
// by itself.
bool start_and_kill(const fs::path& out, int checkpoints) {
  const fs::path state = out / "state.relight";
  std::optional<ino_t> before = number_of(state);
  const pid_t child = start_program(arguments(out));
  int status = 0;
  const auto late = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (const auto now = number_of(state); now && now != before) before = now, --checkpoints;
    if (checkpoints <= 0 || std::chrono::steady_clock::now() > late) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

std::string joined(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += "'" + word + "' ";
  return line;
}

// Files of one picture: the bits of every pixel. (Their headers hold the time of writing.)
bool same_bits(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() && !a.pixels.empty() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

void expect_same_pictures(const fs::path& a, const fs::path& b) {
  for (const char* file : {"direct.exr", "indirect.exr", "total.exr", "variance.exr"})
    EXPECT_TRUE(same_bits(read_exr(a / file), read_exr(b / file))) << file;
  const auto json = nlohmann::json::parse(read_text(b / "reference.json"));
  int layers = 0;
  for (const auto& [name, mean] : json.at("mean_radiance_by_class").items())
    for (const char* file : {"layers.exr", "layers_variance.exr"}) {
      EXPECT_TRUE(same_bits(read_exr_layer(a / file, name), read_exr_layer(b / file, name))) << name;
      ++layers;
    }
  EXPECT_GE(layers, 6);
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

// Killed after the first checkpoint, after some more, and with what a process killed while it wrote one
// leaves behind: half a checkpoint under a temporary name, half a line of convergence. Red if the state is
// not loaded, is loaded but batches count from 0, or lines of lost batches stay in convergence.csv.
TEST(ReferenceCommand, KilledInTheMiddleAndGoneOnWithGivesTheSameFiles) {
  TemporaryFolder folder;
  const fs::path killed = folder.path() / "killed", whole = folder.path() / "whole";
  ASSERT_TRUE(start_and_kill(killed, 1));
  const std::string first_batch = lines_of(killed / "convergence.csv").at(1);
  ASSERT_TRUE(start_and_kill(killed, 3));
  const std::string state = read_text(killed / "state.relight");
  write_text(killed / "state.4711-0.tmp.relight", state.substr(0, state.size() / 2));
  std::string csv = read_text(killed / "convergence.csv");
  write_text(killed / "convergence.csv", csv + "9.999,10000,0.5\n9.9");
  ASSERT_FALSE(fs::exists(killed / "total.exr")) << "it was to be killed in the middle";

  const ProgramResult resumed = run_program(joined(arguments(killed)));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  ASSERT_EQ(run_program(joined(arguments(whole))).exit_code, 0);
  expect_same_pictures(killed, whole);

  const std::vector<std::string> lines = lines_of(killed / "convergence.csv");
  ASSERT_EQ(lines.size(), 49u) << "a head and 48 batches";
  EXPECT_EQ(lines[1], first_batch) << "with its time: the first batch was not rendered anew";
  for (size_t i = 1; i < lines.size(); ++i)
    EXPECT_NE(lines[i].find(fmt::format(",{},", 8 * i)), std::string::npos) << lines[i];
}

}  // namespace
}  // namespace relight::test
