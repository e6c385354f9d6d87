// Mistakes on the command line: exit code 2, a message that names the valid choices, and nothing started.
#include <gtest/gtest.h>

#include "program.h"

namespace relight::test {
namespace {

void expect_usage_error(const std::string& arguments, const std::vector<std::string>& words) {
  const ProgramResult result = run_program(arguments);
  EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.out << result.err;
  for (const std::string& word : words) {
    EXPECT_NE(result.err.find(word), std::string::npos) << arguments << "\nlacks '" << word << "':\n"
                                                        << result.err;
  }
}

const char* const everything_else = " --lights spot --view 8x6 --methods path_tracing ";

// Red if a subcommand is not registered, or its help throws.
TEST(Help, EverySubcommandHasOne) {
  for (const char* command : {"", "scene", "scene list", "scene info", "methods", "render", "reference",
                              "compare", "report", "cache", "cache list", "cache clear"}) {
    const ProgramResult result = run_program(std::string(command) + " --help");
    EXPECT_EQ(result.exit_code, 0) << command;
    EXPECT_NE(result.out.find("Usage"), std::string::npos) << command;
  }
}

// Red if the top-level parser forgets to list its commands.
TEST(UsageErrors, UnknownCommandListsCommands) {
  expect_usage_error("fly", {"scene", "methods", "compare"});
  expect_usage_error("", {"scene", "methods", "compare"});
}

// Red if the message lists the options of another command.
TEST(UsageErrors, UnknownOptionListsOptionsOfThatCommand) {
  expect_usage_error("compare --scen cornell", {"--scene", "--methods"});
}

TEST(UsageErrors, UnknownSceneListsBuiltInScenes) {
  expect_usage_error("scene info cornel", {"'cornel'", "cornell", "colonnade"});
  expect_usage_error("scene info cornell:boxs=1", {"boxs", "boxes"});
  TemporaryFolder folder;
  expect_usage_error("compare --scene nowhere.obj --out " + folder / "out" + everything_else,
                     {"nowhere.obj", "cornell"});
}

TEST(UsageErrors, UnknownMethodListsMethods) {
  expect_usage_error("methods path_tracin", {"'path_tracin'", "path_tracing", "direct_to_indirect"});
  expect_usage_error("compare --scene cornell --methods nope --out /tmp", {"'nope'", "path_tracing"});
}

TEST(UsageErrors, UnknownKnobListsKnobsAndBadValueItsRange) {
  TemporaryFolder folder;
  const std::string start = "compare --scene cornell --out " + folder / "out" + everything_else;
  expect_usage_error(start + "--set path_tracing.sample=3", {"sample", "time_ms"});
  expect_usage_error(start + "--set path_tracing.samples=-1", {"samples", "-1"});
  expect_usage_error(start + "--set path_tracing.estimator=magic", {"magic", "next_event", "light_vertex"});
  // A typing error in the method's name must not silently leave the default in place.
  expect_usage_error(start + "--set path_tracin.samples=3", {"path_tracin", "path_tracing"});
}

TEST(UsageErrors, UnknownLightingListsPresets) {
  TemporaryFolder folder;
  expect_usage_error("compare --scene cornell --methods path_tracing --lights spt --out " + folder / "out",
                     {"'spt'", "spot", "omni"});
}

TEST(UsageErrors, BadNumbersAreRefusedByName) {
  TemporaryFolder folder;
  const std::string start =
      "compare --scene cornell --methods path_tracing --lights spot --out " + folder / "out";
  expect_usage_error(start + " --view 640", {"--view", "640x480"});
  expect_usage_error(start + " --bounces 3..1", {"--bounces"});
  expect_usage_error(start + " --reference-samples 7", {"--reference-samples", "8"});
  expect_usage_error(start + " --reference-estimator x", {"next_event", "light_vertex"});
  expect_usage_error(start + " --repeats -1", {"--repeats"});
  expect_usage_error(start + " --threads -2", {"--threads"});
  expect_usage_error(start + " --gpu vulkan", {"osmesa", "egl"});
  expect_usage_error("reference --scene cornell --lights spot --glossy x --out " + folder / "out",
                     {"none, eye, all"});
  expect_usage_error(
      "reference --scene cornell --lights spot --checkpoint-seconds -1 --out " + folder / "out",
      {"--checkpoint-seconds", "-1"});
  expect_usage_error("render --scene cornell --lights spot --method path_tracing --out " + folder / "a.jpg",
                     {".exr", ".png"});
}

// Red if an unwritable output is found only after the work. A file in place of a folder refuses root, too.
TEST(UsageErrors, UnwritableOutputIsRefusedAtOnce) {
  TemporaryFolder folder;
  write_text(folder / "file", "");
  expect_usage_error("compare --scene cornell --out " + folder / "file/sub" + everything_else,
                     {"--out", "file/sub"});
}

// Red if the plan is checked after the scene is loaded: the scene here takes minutes and would be loaded in
// vain.
TEST(UsageErrors, AreFoundBeforeTheSceneIsLoaded) {
  TemporaryFolder folder;
  const ProgramResult result = run_program(
      "compare --scene colonnade:detail=16 --methods path_tracing --set path_tracing.nope=1 --out " +
          folder / "out",
      "timeout 5 ");
  EXPECT_EQ(result.exit_code, 2) << result.err;
}

}  // namespace
}  // namespace relight::test
