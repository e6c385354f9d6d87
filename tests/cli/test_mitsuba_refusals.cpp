// relight scene export: what is refused, and how.
#include <gtest/gtest.h>

#include "program.h"

namespace relight::test {
namespace {

// Red if: a mistake is accepted, or its message doesn't name the option, the value and what is valid.
TEST(MitsubaExport, MistakesAreRefusedByName) {
  TemporaryFolder folder;
  const std::string out = " --out " + folder / "out";
  const struct {
    std::string arguments;
    std::vector<std::string> words;
  } mistakes[] = {
      {"cornell --format obj --lights spot" + out, {"--format", "obj", "mitsuba"}},
      {"cornell --lights spot" + out, {"--format"}},
      {"cornell --format mitsuba --lights sun" + out, {"--lights", "sun", "omni", "spot"}},
      {"cornell --format mitsuba" + out, {"--lights", "spot"}},
      {"cornell --format mitsuba --lights spot --view 5" + out, {"--view", "5", "640x480"}},
      {"cornell --format mitsuba --lights spot --max-bounces -1" + out, {"--max-bounces", "-1", "64"}},
      {"nowhere --format mitsuba --lights spot" + out, {"nowhere", "cornell"}},
      {"cornell --format mitsuba --lights spot --out /dev/null/x", {"--out", "/dev/null/x"}},
  };
  for (const auto& [arguments, words] : mistakes) {
    const ProgramResult result = run_program("scene export " + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << "\n" << result.err;
    for (const std::string& word : words)
      EXPECT_NE(result.err.find(word), std::string::npos) << arguments << "\n" << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out/scene.xml"));
}

// Red if: a model is written as another one.
TEST(MitsubaExport, AnUnknownReflectionModelIsRefused) {
  TemporaryFolder folder;
  write_text(
      folder / "ggx.toml",
      "base = \"cornell\"\n[[material]]\nname = \"red\"\nmodel = \"ggx\"\nglossy = 0.2\nalpha = 0.3\n");
  const ProgramResult result = run_program("scene export " + folder / "ggx.toml" +
                                           " --format mitsuba --lights spot --out " + folder / "out");
  EXPECT_EQ(result.exit_code, 1) << result.out;
  for (const char* word : {"red", "ggx", "diffuse, phong"})
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out/scene.xml"));
}

}  // namespace
}  // namespace relight::test
