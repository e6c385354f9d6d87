// `relight compare` from end to end, through the real program.
#include <gtest/gtest.h>

#include "experiments/method_list.h"
#include "program.h"

namespace relight::test {
namespace {

using Json = nlohmann::json;

const char* const small =
    " --scene cornell --view 48x36 --lights omni --quiet --repeats 2 --reference-samples 64"
    " --set path_tracing.samples=16 --set direct_to_indirect.gather_samples=1024"
    " --methods direct_to_indirect,path_tracing";

// One comparison serves all tests that only look at what it left.
class CompareCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    result = new ProgramResult(run_program(std::string("compare") + small + " --cache " + *folder / "cache" +
                                           " --out " + *folder / "out"));
  }
  static void TearDownTestSuite() {
    delete result;
    delete folder;
  }
  static std::vector<Json> records() { return read_json_lines(*folder / "out/records.jsonl"); }
  static TemporaryFolder* folder;
  static ProgramResult* result;
};
TemporaryFolder* CompareCommand::folder = nullptr;
ProgramResult* CompareCommand::result = nullptr;

TEST_F(CompareCommand, SucceedsAndPrintsATableOfErrorsAndTheLightPathsCompared) {
  ASSERT_EQ(result->exit_code, 0) << result->out << result->err;
  for (const char* word : {"direct_to_indirect", "path_tracing", "relative %", "noise floor %", "E D D L",
                           "not simulated", "more than 1 bounce", "index.html"}) {
    EXPECT_NE(result->out.find(word), std::string::npos) << word << "\n" << result->out;
  }
}

// Red if a promised image is missing.
TEST_F(CompareCommand, LeavesEveryImage) {
  for (const char* method : {"direct_to_indirect", "path_tracing"}) {
    for (const char* what : {"direct", "indirect", "total", "reference", "reference_direct",
                             "reference_indirect", "difference"}) {
      const std::string file = *folder / "out/" + method + "_" + what + ".exr";
      EXPECT_TRUE(std::filesystem::exists(file)) << file;
    }
  }
}

// Red if a promised key is missing or has another type. The list is the program's contract with its readers.
TEST_F(CompareCommand, RecordsHaveEveryPromisedKeyWithItsType) {
  const auto lines = records();
  ASSERT_EQ(lines.size(), 2u);
  for (const Json& r : lines) {
    for (const char* key :
         {"scene", "view", "lighting", "method", "light_paths", "reference_paths", "command"}) {
      EXPECT_TRUE(r.at(key).is_string()) << key;
    }
    EXPECT_TRUE(r.at("knobs").is_object());
    EXPECT_TRUE(r.at("seed").is_number_unsigned());
    EXPECT_TRUE(r.at("not_simulated").is_array());
    const Json& e = r.at("errors");
    for (const char* key :
         {"relative", "relative_edges_out", "relative_hdr", "rmse", "relmse", "bias", "ssim", "max"}) {
      EXPECT_TRUE(e.at(key).is_number()) << key;
      EXPECT_TRUE(e.at("noise_floor").at(key).is_number()) << key;
      EXPECT_TRUE(r.at("errors_indirect").at(key).is_number()) << key;
    }
    EXPECT_TRUE(e.at("edge_share").is_number());
    const Json& t = r.at("time");
    EXPECT_TRUE(t.at("precompute_s").is_number());
    for (const char* key : {"median", "min", "max"})
      EXPECT_GT(t.at("relight_ms").at(key).get<double>(), 0.0) << key;
    EXPECT_EQ(t.at("relight_ms").at("repeats").get<int>(), 2);
    EXPECT_FALSE(t.at("stages").at("relight").empty());
    EXPECT_GT(r.at("memory_bytes").at("process_peak").get<int64_t>(), 0);
    EXPECT_TRUE(r.at("counters").is_object());
    const Json& p = r.at("provenance");
    for (const char* key : {"commit", "compiler", "cpu", "gl_renderer", "gl_version", "date"}) {
      EXPECT_FALSE(p.at(key).get<std::string>().empty()) << key;
    }
    EXPECT_GT(p.at("threads").get<int>(), 0);
    EXPECT_TRUE(r.at("failed_stages").empty());
  }
}

// Red if a knob's resolved value, default or set, is not in the record.
TEST_F(CompareCommand, RecordsHoldEveryKnobOfTheirMethod) {
  const MethodList methods = make_all_methods();
  for (const Json& r : records()) {
    const Method& method = find_method(methods, r.at("method"));
    for (const Knob& knob : method.knobs()) EXPECT_TRUE(r.at("knobs").contains(knob.name)) << knob.name;
  }
  EXPECT_EQ(records()[0].at("knobs").at("gather_samples"), "1024");
}

// Red if a method is compared with the wrong picture: both carry the same paths and converge to the same
// image.
TEST_F(CompareCommand, BothMethodsComeCloseToTheReference) {
  for (const Json& r : records()) {
    EXPECT_LT(r.at("errors").at("relative").get<double>(), 0.2) << r.at("method");
    EXPECT_LT(std::abs(r.at("errors").at("bias").get<double>()), 0.15) << r.at("method");
  }
}

TEST_F(CompareCommand, PageHasNoExternalAddress) {
  const std::string page = read_text(*folder / "out/index.html");
  EXPECT_EQ(page.find("http:"), std::string::npos);
  EXPECT_EQ(page.find("https:"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
}

// Red if a stored command leaves out a setting, or a run is not repeatable. path_tracing has a sample budget
// here.
TEST_F(CompareCommand, TheRecordedCommandReproducesTheErrorsExactly) {
  for (const Json& before : records()) {
    TemporaryFolder again;
    std::string command = before.at("command");
    ASSERT_EQ(command.rfind("relight ", 0), 0u);
    // The last --out counts; without the cache nothing can be carried over from the first run.
    const size_t out = command.find(" --out ");
    ASSERT_NE(out, std::string::npos);
    command = command.substr(8, out - 8) + " --quiet --no-cache --out " + again / "out";
    const ProgramResult repeated = run_program(command);
    ASSERT_EQ(repeated.exit_code, 0) << command << repeated.err;
    const auto after = read_json_lines(again / "out/records.jsonl");
    ASSERT_EQ(after.size(), 1u);
    EXPECT_EQ(after[0].at("errors"), before.at("errors")) << command;
    EXPECT_EQ(after[0].at("errors_indirect"), before.at("errors_indirect")) << command;
    EXPECT_EQ(after[0].at("knobs"), before.at("knobs"));
  }
}

// Red if the second run traces its reference again, or finds other numbers with cached data than with fresh.
TEST_F(CompareCommand, ASecondRunUsesTheCacheAndFindsTheSame) {
  const ProgramResult second = run_program(std::string("compare") + small + " --cache " + *folder / "cache" +
                                           " --out " + *folder / "second");
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_NE(result->out.find("traced in"), std::string::npos) << result->out;
  EXPECT_EQ(second.out.find("traced in"), std::string::npos) << second.out;
  const auto before = records(), after = read_json_lines(*folder / "second/records.jsonl");
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_TRUE(after.at(i).at("reference").at("from_cache").get<bool>());
    EXPECT_EQ(after[i].at("errors"), before[i].at("errors"));
  }
}

// Red if `report` needs anything but the folder, or makes another page than compare did.
TEST_F(CompareCommand, ReportMakesTheSamePageAgain) {
  const std::string page = read_text(*folder / "out/index.html");
  std::filesystem::remove(*folder / "out/index.html");
  const ProgramResult report = run_program("report " + *folder / "out");
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(read_text(*folder / "out/index.html"), page);
}

}  // namespace
}  // namespace relight::test
