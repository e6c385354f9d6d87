// relight references: list, check, update, the way a person would type them.
#include <gtest/gtest.h>

#include "stored_session.h"
#include "tests/cli/program.h"

namespace relight::test {
namespace {

constexpr const char* quickest = "cornell_spot_one_bounce";

std::string stored_folder() { return " --quiet --folder '" + images_folder().string() + "' "; }

TEST(ReferencesCommand, ListShowsEveryPictureWithItsError) {
  const ProgramResult result = run_program("references list" + stored_folder());
  EXPECT_EQ(result.exit_code, 0) << result.out;
  for (const StoredReference& reference : stored_references())
    EXPECT_NE(result.out.find(reference.name), std::string::npos) << reference.name;
  EXPECT_NE(result.out.find('%'), std::string::npos);
  EXPECT_EQ(result.out.find("MISSING"), std::string::npos) << result.out;
}

TEST(ReferencesCommand, CheckFindsThePicturesTheSame) {
  const ProgramResult result =
      run_program(std::string("references check ") + quickest + stored_folder() + "--seed 5");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("same"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("p ="), std::string::npos) << result.out;
}

// Red if: a picture of another scene is compared, or skipped, without a word.
TEST(ReferencesCommand, CheckFailsOnAStaleHash) {
  const TemporaryFolder folder;
  std::filesystem::copy(images_folder() / quickest, folder.path() / quickest);
  const std::string file = folder / quickest + "/reference.json";
  auto json = nlohmann::ordered_json::parse(read_text(file));
  json["identity"]["scene_hash"] = "0123456789abcdef";
  write_text(file, json.dump());
  const ProgramResult result = run_program(std::string("references check --quiet ") + quickest +
                                           " --folder " + folder.path().string());
  EXPECT_EQ(result.exit_code, 1) << result.out;
  EXPECT_NE(result.out.find("STALE"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("0123456789abcdef"), std::string::npos) << result.out;
}

TEST(ReferencesCommand, CheckFailsOnAMissingPicture) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program(std::string("references check --quiet ") + quickest +
                                           " --folder " + folder.path().string());
  EXPECT_EQ(result.exit_code, 1) << result.out;
  EXPECT_NE(result.err.find("relight references update"), std::string::npos) << result.err;
}

TEST(ReferencesCommand, UnknownNamesFailWithTheValidOnes) {
  const ProgramResult result = run_program("references check nonsense");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("cornell_spot"), std::string::npos) << result.err;
}

// Red if: an update is not repeatable, or says nothing of what it replaced. The old picture is given another
// hash and is twice as bright.
TEST(ReferencesCommand, UpdateStoresTheSamePictureAgainAndTellsWhatChanged) {
  const TemporaryFolder folder;
  StoredPicture old = load_stored(images_folder() / quickest);
  old.identity["scene_hash"] = "0123456789abcdef";
  save_stored(folder.path() / quickest, brighter(old.picture, 2.0), old.identity);
  const ProgramResult result = run_program(std::string("references update --quiet ") + quickest +
                                           " --folder " + folder.path().string());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* word : {"scene_hash: stored \"0123456789abcdef\"", "DIFFERS",
                           "mean of indirect light -50.0", "% of the tiles differ by more than 3"})
    EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
  const StoredPicture now = load_stored(folder.path() / quickest),
                      before = load_stored(images_folder() / quickest);
  for (size_t i = 0; i < now.picture.pixels.mean.pixels.size(); ++i)
    EXPECT_LE(glm::length(now.picture.pixels.mean.pixels[i] - before.picture.pixels.mean.pixels[i]),
              1e-3f * glm::length(before.picture.pixels.mean.pixels[i]));
}

}  // namespace
}  // namespace relight::test
