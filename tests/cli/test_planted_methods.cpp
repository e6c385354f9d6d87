// A method that turns wrong between the published run and the fresh one is shown as such: which column, which
// words. The whole way: experiment, published results, fresh run, regression; and the table of a comparison.
#include <gtest/gtest.h>

#include "experiments/compare/compare.h"
#include "experiments/regress/publish.h"
#include "experiments/regress/regress.h"
#include "experiments/run/run_experiment.h"
#include "fake_methods.h"
#include "program.h"

namespace relight::test {
namespace {

const char* const experiment =
    "title = 'planted'\nview = '24x18'\nreference_samples = 256\nrepeats = 5\n"
    "[[runs]]\nscenes = ['cornell']\nlights = ['omni']\nmethod = 'planted'\n";

MethodList only(Version version) {
  MethodList methods;
  methods.push_back(make_version(version));
  return methods;
}

// The records of the right version, published, and those of `version`, fresh.
class Planted {
 public:
  explicit Planted(Version version) {
    write_text(folder_ / "planted.toml", experiment);
    run(Version::right, "right");
    publish(folder_ / "right", folder_ / "results");
    run(version, "fresh");
    std::vector<std::string> notes;
    regression = compare_results("planted", read_results(folder_ / "results", notes),
                                 read_results(folder_ / "fresh", notes), {});
    EXPECT_TRUE(notes.empty());
    text = regression_text(regression);
  }
  Regression regression;
  std::string text;

  // The weight of the change called `what`, in words; "none" if there is none.
  std::string weight(const std::string& what) const {
    for (const Change& change : regression.runs.at(0).changes)
      if (change.what == what) return change.weight == Weight::note ? "note" : "change";
    return "none";
  }
  bool says(const std::string& words) const { return text.find(words) != std::string::npos; }

 private:
  void run(Version version, const std::string& out) {
    SessionOptions session;
    session.quiet = session.no_cache = true;
    const MethodList methods = only(version);
    const std::filesystem::path folder = folder_ / out;
    run_experiment(make_runs(read_experiment(folder_ / "planted.toml"), session, methods, folder), folder,
                   false);
  }
  TemporaryFolder folder_;
};

// Red if rounding of the published numbers, times of another run or a counter of the cache count as changes.
TEST(PlantedMethod, TheRightOneIsTheSame) {
  const Planted planted(Version::right);
  EXPECT_TRUE(planted.regression.good()) << planted.text;
  EXPECT_EQ(planted.regression.runs.size(), 1u);
  EXPECT_TRUE(planted.says("1 the same, 0 changed")) << planted.text;
}

// Red if an error is compared without its interval (a bias of 3 % is 30 intervals), or the wrong way round.
TEST(PlantedMethod, ThreePercentTooDarkIsAnErrorBeyondItsInterval) {
  const Planted planted(Version::three_percent_dark);
  EXPECT_FALSE(planted.regression.good());
  for (const char* what : {"relative", "relative_hdr", "rmse", "bias", "indirect bias"})
    EXPECT_EQ(planted.weight(what), "change") << what << "\n" << planted.text;
  for (const char* what : {"failed", "relight", "count.pixels"}) EXPECT_EQ(planted.weight(what), "none");
  EXPECT_TRUE(planted.says("-> -3.0")) << planted.text;  // in the column of the bias
  EXPECT_TRUE(planted.says("worse, beyond the intervals")) << planted.text;
}

// Red if NaN compares as equal to everything.
TEST(PlantedMethod, ALeakedNanIsAFailureThatNamesThePixel) {
  const Planted planted(Version::leaks_nan);
  EXPECT_FALSE(planted.regression.good());
  EXPECT_EQ(planted.weight("failed"), "change");
  EXPECT_EQ(planted.weight("relative"), "change");
  EXPECT_EQ(planted.weight("bias"), "change");
  EXPECT_TRUE(planted.says("FAILED: indirect image: 1 pixels are not finite, the first at (3, 2)"))
      << planted.text;
  EXPECT_TRUE(planted.says("-> not finite")) << planted.text;
}

// Red if times are not compared, or differences in place of ratios.
TEST(PlantedMethod, TenTimesSlowerIsALongerRelightOfTheStageThatSlowedDown) {
  const Planted planted(Version::ten_times_slower);
  EXPECT_FALSE(planted.regression.good());
  EXPECT_EQ(planted.weight("relight"), "change") << planted.text;
  for (const char* what : {"failed", "relative", "bias", "count.pixels"})
    EXPECT_EQ(planted.weight(what), "none") << what << "\n" << planted.text;
  EXPECT_TRUE(planted.says("slower by")) << planted.text;
  EXPECT_TRUE(planted.says("mostly stage pretend")) << planted.text;
}

// The page says the same, and is one file.
TEST(PlantedMethod, ThePageShowsWhatChanged) {
  const Planted planted(Version::leaks_nan);
  const std::string page = regression_page({planted.regression}, "");
  EXPECT_NE(page.find("tr class=changed"), std::string::npos);
  EXPECT_NE(page.find("the first at (3, 2)"), std::string::npos);
  EXPECT_NE(page.find("&rarr; fresh"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
}

// The table that `relight compare` prints.
std::string compare_table(Version version) {
  const TemporaryFolder folder;
  CompareOptions options;
  options.session.scene = "cornell", options.session.lights = "omni", options.session.view = "24x18";
  options.session.quiet = options.session.no_cache = true;
  options.methods = "planted";
  options.reference_samples = 256, options.repeats = 5;
  options.out = folder / "out";
  const MethodList methods = only(version);
  return summary_text(compare(make_plan(options, methods)));
}

// The cell under `column` of the table's first row.
double cell(const std::string& table, const std::string& column) {
  const size_t row = table.find("\nplanted") + 1;
  const size_t end = table.find(column) + column.size();  // numbers are aligned to the right
  const size_t start = table.find_last_of(' ', row + end - 1) + 1;
  return std::stod(table.substr(start, row + end - start));
}

// Red if the table has no column that gives the wrong one away.
TEST(PlantedMethod, TheTableOfAComparisonShowsEachOfThem) {
  const std::string right = compare_table(Version::right);
  EXPECT_NEAR(cell(right, "bias %"), 0.0, 0.3) << right;
  EXPECT_LT(cell(right, "relight ms"), 15.0) << right;
  const std::string dark = compare_table(Version::three_percent_dark);
  EXPECT_NEAR(cell(dark, "bias %"), -3.0, 0.3) << dark;
  EXPECT_GT(cell(dark, "relative %"), 2.5 * cell(dark, "noise floor %")) << dark;
  const std::string nan = compare_table(Version::leaks_nan);
  EXPECT_NE(nan.find("planted (FAILED)"), std::string::npos) << nan;
  EXPECT_NE(nan.find("not finite"), std::string::npos) << nan;
  const std::string slow = compare_table(Version::ten_times_slower);
  EXPECT_GE(cell(slow, "relight ms"), 30.0) << slow;
}

}  // namespace
}  // namespace relight::test
