// relight render --frames: the real program on an animated lighting.
#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "experiments/options/frame_times.h"
#include "experiments/usage_error.h"
#include "tests/cli/program.h"

namespace relight {
namespace {

using test::ProgramResult;
using test::read_text;
using test::run_program;
using test::TemporaryFolder;

const char* const moving =
    "[[light]]\ntype = \"omni\"\nposition = [0, 1.7, 0.2]\nintensity = 1\n"
    "[[light.keyframe]]\ntime = 0\nintensity = 1\n[[light.keyframe]]\ntime = 2\nintensity = 3\n";

std::string command(const TemporaryFolder& folder, const std::string& more) {
  return "render --scene cornell --lights " + (folder / "moving.toml") +
         " --view 16x12 --quiet --no-cache --method path_tracing --set path_tracing.samples=1 --out " +
         (folder / "out/frame.exr") + " " + more;
}

float brightness(const std::string& file) {
  float sum = 0.0f;
  for (const glm::vec3& p : read_exr(file).pixels) sum += p.x;
  return sum;
}

// Red if a frame's time is not divided by fps; all frames show the time of the first.
TEST(RenderFrames, ShowTheLightingAtTheirTimes) {
  const TemporaryFolder folder;
  test::write_text(folder / "moving.toml", moving);
  const ProgramResult run = run_program(command(folder, "--frames 0:8:4 --fps 4"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("3 frames, 3 of them made now"), std::string::npos) << run.out;
  const float first = brightness(folder / "out/frame_0000.exr");
  EXPECT_GT(first, 0.0f);
  EXPECT_NEAR(brightness(folder / "out/frame_0004.exr"), 2.0f * first, 1e-3f * first);
  EXPECT_NEAR(brightness(folder / "out/frame_0008.exr"), 3.0f * first, 1e-3f * first);
  EXPECT_FALSE(std::filesystem::exists(folder / "out/frame_0001.exr"));

  ASSERT_EQ(run_program(command(folder, "--times 1,0")).exit_code, 0);
  EXPECT_NEAR(brightness(folder / "out/frame_0001.exr"), 2.0f * first, 1e-3f * first);
  EXPECT_NEAR(brightness(folder / "out/frame_0002.exr"), first, 1e-3f * first);
  // One picture of the same lighting, at --at.
  ASSERT_EQ(run_program(command(folder, "--at 2")).exit_code, 0);
  EXPECT_NEAR(brightness(folder / "out/frame.exr"), 3.0f * first, 1e-3f * first);
  // The same moment in the lighting's name; two moments are a mistake.
  const std::string file = folder / "moving.toml";
  const auto named = [&](const std::string& more) {
    std::string text = command(folder, more);
    return run_program(text.replace(text.find(file), file.size(), file + "@1"));
  };
  ASSERT_EQ(named("").exit_code, 0);
  EXPECT_NEAR(brightness(folder / "out/frame.exr"), 2.0f * first, 1e-3f * first);
  EXPECT_NE(named("--at 2").err.find("two times"), std::string::npos);
}

// A killed run leaves whole frames only; they are kept, the others made. Red if frames that exist
// are made again, or frames made from something else are taken for these.
TEST(RenderFrames, ResumeKeepsFramesThatExistAndRefusesOthers) {
  const TemporaryFolder folder;
  test::write_text(folder / "moving.toml", moving);
  ASSERT_EQ(run_program(command(folder, "--frames 1:3")).exit_code, 0);
  const std::string second = read_text(folder / "out/frame_0002.exr");
  std::filesystem::remove(folder / "out/frame_0002.exr");
  test::write_text(folder / "out/frame_0003.exr", "kept");
  const ProgramResult run = run_program(command(folder, "--frames 1:3 --resume"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("3 frames, 1 of them made now"), std::string::npos) << run.out;
  EXPECT_EQ(read_exr(folder / "out/frame_0002.exr").pixels.size(), 16u * 12u);
  EXPECT_EQ(read_text(folder / "out/frame_0002.exr").size(), second.size());
  EXPECT_EQ(read_text(folder / "out/frame_0003.exr"), "kept");

  const ProgramResult other = run_program(command(folder, "--frames 1:3 --resume --seed 2"));
  EXPECT_NE(other.exit_code, 0);
  EXPECT_NE(other.err.find("frame_frames.txt"), std::string::npos) << other.err;
  test::write_text(folder / "moving.toml",
                   std::string(moving) + "[[light.keyframe]]\ntime = 3\nintensity = 1\n");
  EXPECT_NE(run_program(command(folder, "--frames 1:3 --resume")).exit_code, 0) << "another animation";
}

TEST(FrameTimes, AreParsedOrRefusedWithTheTextFound) {
  const std::vector<Frame> frames = parse_frames("2:8:3", 2.0);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[1].number, 5);
  EXPECT_EQ(frames[1].time, 2.5);
  EXPECT_EQ(parse_frames("7:7", 24.0).size(), 1u);
  EXPECT_EQ(parse_times("0.5,-1").at(1).time, -1.0);
  for (const char* text : {"", "3", "5:1", "0:9:0", "-1:4", "0:1:2:3", "a:b", "0:1000000", "0:4 "}) {
    try {
      parse_frames(text, 24.0);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("'" + std::string(text) + "'"), std::string::npos);
    }
  }
  for (const char* text : {"", "1,,2", "1;2", "inf", "x"})
    EXPECT_THROW(parse_times(text), UsageError) << text;
  EXPECT_THROW(parse_frames("0:1", 0.0), UsageError);
}

// Red if `scene info` leaves out how lights move.
TEST(SceneInfo, ListsAnimatedLights) {
  const ProgramResult info = run_program(
      "scene info " + (std::filesystem::path(RELIGHT_SOURCE_DIR) / "scenes/cornell_lights.toml").string());
  ASSERT_EQ(info.exit_code, 0) << info.err;
  for (const char* part : {"sweep   animated from 0 to 4 s", "position by 4 keyframes (spline)", "sun_sky",
                           "projector", "uber", "rectangle", "disc", "directional", "shader"})
    EXPECT_NE(info.out.find(part), std::string::npos) << part << "\n" << info.out;
}

}  // namespace
}  // namespace relight
