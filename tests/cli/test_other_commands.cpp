// scene, methods, render, reference, cache: the real program on small input.
#include <algorithm>

#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "common/scene/scene_file.h"
#include "experiments/method_list.h"
#include "program.h"

namespace relight::test {
namespace {

// Red if a built-in scene or one of its parameters is not listed.
TEST(SceneCommand, ListShowsEveryBuiltInSceneAndParameter) {
  const ProgramResult result = run_program("scene list");
  EXPECT_EQ(result.exit_code, 0);
  for (const BuiltinScene& scene : builtin_scenes()) {
    EXPECT_NE(result.out.find(scene.name), std::string::npos) << scene.name;
    for (const auto& parameter : scene.parameters) {
      EXPECT_NE(result.out.find(parameter.name + "="), std::string::npos)
          << scene.name << ":" << parameter.name;
    }
  }
}

TEST(SceneCommand, InfoDescribesABuiltInScene) {
  const ProgramResult result = run_program("scene info cornell");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* word : {"triangles", "closed", "albedo", "spot"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
  }
}

// Red if a broken file counts as a mistake on the command line, or the message does not name it.
TEST(SceneCommand, InfoOnABrokenFileFailsAndNamesIt) {
  TemporaryFolder folder;
  write_text(folder / "broken.toml", "[camera\neye = ");
  write_text(folder / "broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
  for (const char* name : {"broken.toml", "broken.ply"}) {
    const ProgramResult result = run_program("scene info " + folder / name);
    EXPECT_EQ(result.exit_code, 1) << result.out;
    EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
  }
}

// Red if the help of a method is not made from its knob table.
TEST(MethodsCommand, ShowsEveryKnobWithItsDefaultAndSentence) {
  for (const auto& method : make_all_methods()) {
    const ProgramResult result = run_program("methods " + method->name());
    EXPECT_EQ(result.exit_code, 0);
    for (const Knob& knob : method->knobs()) {
      for (const std::string& word : {knob.name, knob.default_value, knob.stage, knob.help}) {
        EXPECT_NE(result.out.find(word), std::string::npos)
            << method->name() << "." << knob.name << ": " << word;
      }
    }
  }
}

// Red if direct and total are mixed up, or the file's size is wrong.
TEST(RenderCommand, WritesTheChosenImage) {
  TemporaryFolder folder;
  for (const char* image : {"direct", "indirect", "total"}) {
    const ProgramResult result = run_program(
        std::string(
            "render --scene cornell --lights spot --view 16x12 --quiet --no-cache --method path_tracing "
            "--set path_tracing.samples=4 --image ") +
        image + " --out " + folder / image + ".exr");
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  const Image direct = read_exr(folder / "direct.exr"), indirect = read_exr(folder / "indirect.exr");
  const Image total = read_exr(folder / "total.exr");
  ASSERT_EQ(total.width, 16);
  ASSERT_EQ(total.height, 12);
  float brightest_indirect = 0.0f;
  for (size_t i = 0; i < total.pixels.size(); ++i) {
    EXPECT_FLOAT_EQ(total.pixels[i].x, direct.pixels[i].x + indirect.pixels[i].x);
    brightest_indirect = std::max(brightest_indirect, indirect.pixels[i].x);
  }
  EXPECT_GT(brightest_indirect, 0.0f);
}

TEST(RenderCommand, WritesPng) {
  TemporaryFolder folder;
  const ProgramResult result = run_program(
      "render --scene cornell --lights spot --view 16x12 --quiet --no-cache --method path_tracing "
      "--set path_tracing.samples=4 --out " +
      folder / "a.png");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_text(folder / "a.png").substr(1, 3), "PNG");
}

// Red if an image is missing, or the noise floor is not that of the variance (it must fall with samples).
TEST(ReferenceCommand, WritesImagesAndANoiseFloorThatFallsWithSamples) {
  TemporaryFolder folder;
  double floors[2];
  for (int i = 0; i < 2; ++i) {
    const std::string out = folder / std::to_string(i);
    const ProgramResult result = run_program(
        "reference --scene cornell --lights spot --view 24x18 --bounces 1..2 --quiet --no-cache --samples " +
        std::to_string(i == 0 ? 32 : 512) + " --out " + out);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    for (const char* name : {"direct", "indirect", "total", "variance"}) {
      EXPECT_EQ(read_exr(out + "/" + name + ".exr").width, 24) << name;
    }
    const auto json = nlohmann::json::parse(read_text(out + "/reference.json"));
    floors[i] = json.at("noise_floor").at("relative").get<double>();
    EXPECT_EQ(json.at("samples_per_pixel").get<int>(), i == 0 ? 32 : 512);
  }
  // 16 times the samples: a quarter of the noise, or less with stratified samples.
  EXPECT_LT(floors[1], 0.4 * floors[0]);
  EXPECT_GT(floors[1], 0.0);
}

// Red if a write that fails half-way leaves a file, or passes for success. The limit on file size stands for
// a full disk: both fail in write().
TEST(ReferenceCommand, LeavesNothingHalfWrittenOnAFullDisk) {
  TemporaryFolder folder;
  const ProgramResult result = run_program(
      "reference --scene cornell --lights spot --view 96x72 --quiet --no-cache --samples 8 --out " +
          folder / "out",
      "trap '' XFSZ; ulimit -f 4; ");
  EXPECT_EQ(result.exit_code, 1) << result.out;
  EXPECT_NE(result.err.find("state.relight"), std::string::npos) << result.err;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "out")) {
    if (entry.path().extension() == ".exr") {
      EXPECT_NO_THROW(read_exr(entry.path())) << entry.path();
    }
    EXPECT_EQ(entry.path().filename().string().find("tmp"), std::string::npos) << entry.path();
  }
}

// Red if more samples start anew, if the same bits do not come of it, or if an earlier run with other
// settings is overwritten without a word.
TEST(ReferenceCommand, GoesOnFromWhatAnEarlierRunLeft) {
  TemporaryFolder folder;
  const auto run = [&](const std::string& out, const std::string& more) {
    return run_program("reference --scene cornell --lights spot --view 24x18 --quiet --bounces 1..3 " + more +
                       " --out " + folder / out);
  };
  ASSERT_EQ(run("parts", "--samples 16").exit_code, 0);
  ASSERT_EQ(run("parts", "--samples 48").exit_code, 0);
  ASSERT_EQ(run("whole", "--samples 48").exit_code, 0);
  for (const char* name : {"indirect", "variance"})
    EXPECT_EQ(read_exr(folder / "parts/" + name + ".exr").pixels,
              read_exr(folder / "whole/" + name + ".exr").pixels);
  const std::string csv = read_text(folder / "parts/convergence.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7) << csv;  // a head and six batches of 8
  const ProgramResult other = run("parts", "--samples 48 --seed 2");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.err.find("state.relight"), std::string::npos) << other.err;
  EXPECT_EQ(run("parts", "--samples 48 --seed 2 --restart").exit_code, 0);
}

// Red if a pattern is ignored, or layers are missing or do not add up.
TEST(ReferenceCommand, WritesLayersThatAddUpAndTheLightThatAPatternTakes) {
  TemporaryFolder folder;
  const std::string common =
      "reference --scene still_life:detail=0.2 --lights spot --view 24x18 --quiet --samples 16 ";
  ASSERT_EQ(run_program(common + "--layers --class-bounces 2 --out " + folder / "all").exit_code, 0);
  const ProgramResult one = run_program(common + "--paths 'E D D L' --out " + folder / "one");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const auto json = nlohmann::json::parse(read_text(folder / "all/reference.json"));
  Image sum(24, 18);
  for (const auto& [name, mean] : json.at("mean_radiance_by_class").items()) {
    const Image layer = read_exr_layer(folder / "all/layers.exr", name);
    for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += layer.pixels[i];
  }
  const Image total = read_exr(folder / "all/total.exr"), picture = read_exr(folder / "one/total.exr");
  const Image layer = read_exr_layer(folder / "all/layers.exr", "b1.D.D.local");
  for (size_t i = 0; i < sum.pixels.size(); ++i) {
    EXPECT_NEAR(sum.pixels[i].y, total.pixels[i].y, 1e-5f * (1.0f + total.pixels[i].y));
    EXPECT_NEAR(picture.pixels[i].y, layer.pixels[i].y, 1e-6f * (1.0f + layer.pixels[i].y));
  }
  const ProgramResult wrong = run_program(common + "--paths 'E D Q L' --out " + folder / "wrong");
  EXPECT_NE(wrong.exit_code, 0);
  EXPECT_NE(wrong.err.find("E D Q L\n      ^"), std::string::npos) << wrong.err;
}

// Red if the cache is not used, listed or emptied, or if clearing removes files that are not the cache's.
TEST(CacheCommand, ListsAndClearsWhatAReferenceLeft) {
  TemporaryFolder folder;
  const std::string cache = " --cache " + folder / "cache";
  const std::string reference =
      "compare --scene cornell --lights spot --view 8x6 --quiet --reference-samples 16 --methods "
      "path_tracing "
      "--set path_tracing.samples=4 --out " +
      folder / "out" + cache;
  EXPECT_NE(run_program("cache list" + cache).out.find("0 files"), std::string::npos);
  EXPECT_NE(run_program(reference).out.find("traced"), std::string::npos);
  EXPECT_NE(run_program(reference).out.find("from the cache"), std::string::npos);
  const ProgramResult listed = run_program("cache list" + cache);
  EXPECT_NE(listed.out.find("reference.images"), std::string::npos) << listed.out;
  // The picture, and what making it logged.
  EXPECT_NE(listed.out.find("2 files"), std::string::npos) << listed.out;
  write_text(folder / "cache/mine.txt", "keep me");
  EXPECT_NE(run_program("cache clear" + cache).out.find("2 files removed"), std::string::npos);
  EXPECT_EQ(read_text(folder / "cache/mine.txt"), "keep me");
  EXPECT_NE(run_program(reference).out.find("traced"), std::string::npos);
}

}  // namespace
}  // namespace relight::test
