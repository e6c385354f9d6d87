// The page, made from records that no program wrote.
#include <limits>

#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "common/run/run_record.h"
#include "experiments/compare/image_files.h"
#include "experiments/compare/not_simulated.h"
#include "experiments/report/data_uri.h"
#include "experiments/report/html.h"
#include "experiments/report/report.h"
#include "experiments/usage_error.h"
#include "program.h"

namespace relight::test {
namespace {

RunRecord record(const std::string& method) {
  RunRecord r;
  r.scene = "sce<ne>";
  r.view = "4x3";
  r.width = 4, r.height = 3;
  r.lighting = "spot";
  r.method = method;
  r.knobs = {{"knob_one", "17"}};
  r.light_paths = r.reference_paths = "E D D L, 1 bounce, local lights";
  r.not_simulated = {"light from the scene's environment"};
  r.command = "relight compare --scene x";
  r.errors.emplace();
  r.errors->value.relative = 0.1234;
  r.errors->noise_floor.relative = 0.0056;
  r.errors_indirect = r.errors;
  r.precompute_s = 1.5;
  r.relight_ms = {12.5, 12.0, 13.0, 5};
  r.precompute_stages = {{"final_gather", 1.4}};
  r.relight_stages = {{"transfer", 0.0125}};
  r.memory_bytes = {{"final_gather", 12'300'000}};
  r.counters = {{"links", 1234567}};
  r.warnings = {"a triangle was <removed>"};
  return r;
}

void write_images(const std::filesystem::path& folder, const std::string& method) {
  for (const char* what : {"total", "reference", "indirect", "reference_indirect"}) {
    write_exr(image_file(folder, method, what), Image(4, 3, glm::vec3(0.25f)));
  }
}

std::string page_of(const std::filesystem::path& folder) {
  write_report(folder);
  return read_text(folder / "index.html");
}

size_t occurrences(const std::string& text, const std::string& word) {
  size_t count = 0;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

// Red if a part of the record does not reach the page.
TEST(Report, ShowsErrorsFloorsTimesSettingsCommandAndWarnings) {
  TemporaryFolder folder;
  append_record(folder / "records.jsonl", record("one"));
  write_images(folder.path(), "one");
  const std::string page = page_of(folder.path());
  for (const char* word : {"12.34", "floor 0.56", "1.50", "12.5", "final gather", "knob_one", "17", "12.3",
                           "relight compare --scene x", "E D D L", "scene&#39;s environment", "transfer"}) {
    EXPECT_NE(page.find(word), std::string::npos) << word;
  }
}

// Red if text from a scene file becomes markup.
TEST(Report, EscapesTextOfScenesAndMethods) {
  TemporaryFolder folder;
  append_record(folder / "records.jsonl", record("one"));
  const std::string page = page_of(folder.path());
  EXPECT_EQ(page.find("sce<ne>"), std::string::npos);
  EXPECT_NE(page.find("sce&lt;ne&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<removed>"), std::string::npos);
}

// Red if the page needs a network or other files.
TEST(Report, IsSelfContained) {
  TemporaryFolder folder;
  append_record(folder / "records.jsonl", record("one"));
  write_images(folder.path(), "one");
  const std::string page = page_of(folder.path());
  for (const char* word : {"http:", "https:", "src='/", "<link", "@import", "url("}) {
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(occurrences(page, "src='data:image/png;base64,"),
            6u);  // reference, method, difference: total and indirect
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    EXPECT_NE(entry.path().extension(), ".png") << "left behind: " << entry.path();
  }
}

// Red if a missing image ends the report, or a failed method disappears from it.
TEST(Report, MissingImagesAndFailedMethodsLeaveANote) {
  TemporaryFolder folder;
  append_record(folder / "records.jsonl", record("one"));
  RunRecord failed = record("two");
  failed.errors.reset();
  failed.errors_indirect.reset();
  failed.failed_stages = {"precompute: it broke"};
  append_record(folder / "records.jsonl", failed);
  const std::string page = page_of(folder.path());
  EXPECT_NE(page.find("image file missing"), std::string::npos);
  EXPECT_NE(page.find("precompute: it broke"), std::string::npos);
}

TEST(Report, OfAFolderWithoutRecordsFails) {
  TemporaryFolder folder;
  EXPECT_THROW(write_report(folder.path()), Error);
  write_text(folder / "records.jsonl", "{not json\n");
  EXPECT_THROW(write_report(folder.path()), Error);
}

// Red if an unreadable line takes the others with it or is passed over in silence.
TEST(Report, ATornRecordIsLeftOutAndSaid) {
  TemporaryFolder folder;
  write_text(folder / "records.jsonl", "{\"scene\": \"half\n");
  append_record(folder / "records.jsonl", record("one"));
  EXPECT_NE(page_of(folder.path()).find("left out"), std::string::npos);
}

// RFC 4648, section 10. Red if padding is wrong.
TEST(Base64, MatchesTheTestVectors) {
  const auto encode = [](const std::string& s) {
    return report::base64(std::vector<unsigned char>(s.begin(), s.end()));
  };
  EXPECT_EQ(encode(""), "");
  EXPECT_EQ(encode("f"), "Zg==");
  EXPECT_EQ(encode("fo"), "Zm8=");
  EXPECT_EQ(encode("foo"), "Zm9v");
  EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
}

TEST(Html, NumbersReadWell) {
  EXPECT_EQ(report::percent_text(0.12345), "12.35&#8239;%");
  EXPECT_EQ(report::percent_text(std::numeric_limits<double>::quiet_NaN()), "not finite");
  EXPECT_EQ(report::count_text(1234567), "1&#8239;234&#8239;567");
  EXPECT_EQ(report::count_text(123), "123");
  EXPECT_EQ(report::count_text(-123), "-123");
  EXPECT_EQ(report::seconds_text(0.0125), "12.5&#8239;ms");
  EXPECT_EQ(report::seconds_text(245.0), "4&#8239;min 5&#8239;s");
}

// Red if an effect of the scene that a method leaves out is not named, or one is named that the scene does
// not have.
TEST(NotSimulated, NamesWhatTheSceneHasAndThePathsLeaveOut) {
  Scene scene;
  scene.materials.resize(2);
  const LightPaths diffuse_one_bounce;
  EXPECT_EQ(not_simulated(diffuse_one_bounce, scene).size(), 1u);  // more bounces
  scene.materials[0].glossy = glm::vec3(0.2f);
  EXPECT_EQ(not_simulated(diffuse_one_bounce, scene).size(), 3u);
  scene.materials[0].emission = glm::vec3(1.0f);
  scene.environment.radiance = glm::vec3(1.0f);
  EXPECT_EQ(not_simulated(diffuse_one_bounce, scene).size(), 5u);
  EXPECT_EQ(not_simulated(LightPaths{1, 8, true, true, true, -1, true}, scene).size(), 1u);
}

}  // namespace
}  // namespace relight::test
