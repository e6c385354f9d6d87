// The runner that compares methods, on methods whose outcome is known.
#include <cmath>

#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "experiments/compare/compare.h"
#include "experiments/compare/image_files.h"
#include "fake_methods.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "program.h"

namespace relight::test {
namespace {

struct Comparison {
  MethodList methods;
  CompareOptions options;
  TemporaryFolder folder;

  Comparison() {
    options.session.scene = "cornell";
    options.session.lights = "omni";
    options.session.view = "24x18";
    options.session.quiet = true;
    options.session.no_cache = true;
    options.reference_samples = 256;
    options.repeats = 1;
    options.out = folder / "out";
  }
  void add(std::unique_ptr<Method> method) {
    if (!options.methods.empty()) options.methods += ",";
    options.methods += method->name();
    methods.push_back(std::move(method));
  }
  std::vector<RunRecord> run() { return compare(make_plan(options, methods)); }
};

// Red if method and reference are swapped in size, exposed differently, or if the reference is not of the
// same paths.
TEST(CompareRunner, ExactMethodHasNoErrorBeyondTheNoise) {
  Comparison comparison;
  comparison.add(make_exact_method());
  const RunRecord record = comparison.run().front();
  ASSERT_TRUE(record.failed_stages.empty()) << record.failed_stages.front();
  ASSERT_TRUE(record.errors && record.errors_indirect);
  // The method's own noise is like the reference's: both together are sqrt(2) of the floor.
  for (const auto* errors : {&*record.errors, &*record.errors_indirect}) {
    EXPECT_LT(errors->value.relative, 2.0 * errors->noise_floor.relative);
    EXPECT_GT(errors->value.relative, 0.0);
    EXPECT_GT(errors->value.ssim, 0.9);
  }
  // Direct light is exact in both, so the error of the total lies in the indirect light alone.
  EXPECT_NEAR(record.errors->value.rmse, record.errors_indirect->value.rmse, 1e-6);
}

// Red if errors are squared, normalised by the wrong image, or taken from the wrong pair of images.
TEST(CompareRunner, TenPercentMethodHasAnErrorOfTenPercent) {
  Comparison comparison;
  comparison.add(make_ten_percent_method());
  const RunRecord record = comparison.run().front();
  ASSERT_TRUE(record.errors);
  EXPECT_NEAR(record.errors->value.relative_hdr, 0.1, 0.01);
  EXPECT_NEAR(record.errors->value.bias, 0.1, 0.005);
  EXPECT_NEAR(record.errors_indirect->value.bias, 0.1, 0.02);
}

// Red if one failing method ends the comparison, or its failure is not told.
TEST(CompareRunner, AThrowingMethodLeavesARecordAndTheOthersRun) {
  Comparison comparison;
  comparison.add(make_throwing_method("precompute"));
  comparison.add(make_throwing_method("relight"));
  comparison.add(make_wrong_size_method());
  comparison.add(make_exact_method());
  const auto records = comparison.run();
  ASSERT_EQ(records.size(), 4u);
  ASSERT_EQ(records[0].failed_stages.size(), 1u);
  EXPECT_EQ(records[0].failed_stages[0], "precompute: broken on purpose");
  EXPECT_EQ(records[1].failed_stages.at(0), "relight: broken on purpose");
  EXPECT_NE(records[2].failed_stages.at(0).find("23x18"), std::string::npos) << records[2].failed_stages[0];
  EXPECT_TRUE(records[3].failed_stages.empty());
  EXPECT_TRUE(records[3].errors);
  EXPECT_FALSE(records[0].errors);
  EXPECT_EQ(read_json_lines(comparison.folder / "out/records.jsonl").size(), 4u);
  const std::string page = read_text(comparison.folder / "out/index.html");
  EXPECT_NE(page.find("broken on purpose"), std::string::npos);
  EXPECT_NE(summary_text(records).find("FAILED: relight: broken on purpose"), std::string::npos);
}

// Red if a repeat profits from the light that the one before it left behind: it would report the time of
// doing nothing (tried: without forget() before each repeat, lights_cached is 1).
TEST(CompareRunner, EveryTimedRelightShadesItsLightsAfresh) {
  Comparison comparison;
  comparison.add(make_direct_to_indirect());
  comparison.options.settings = {"direct_to_indirect.gather_samples=1024", "direct_to_indirect.device=cpu"};
  comparison.options.repeats = 4;
  const RunRecord record = comparison.run().front();
  ASSERT_TRUE(record.failed_stages.empty()) << record.failed_stages.front();
  EXPECT_EQ(record.counters.at("lights_shaded"), 1);
  EXPECT_EQ(record.counters.at("lights_cached"), 0);
  EXPECT_GT(record.counters.at("shadow_rays"), 0);
}

// Red if NaN is averaged away, or reported without saying where.
TEST(CompareRunner, ANonFinitePixelIsAFailureThatNamesImageAndPixel) {
  Comparison comparison;
  comparison.add(make_nan_method());
  const RunRecord record = comparison.run().front();
  ASSERT_EQ(record.failed_stages.size(), 2u);
  EXPECT_NE(record.failed_stages[0].find("indirect"), std::string::npos);
  EXPECT_NE(record.failed_stages[0].find("(3, 2)"), std::string::npos) << record.failed_stages[0];
  EXPECT_EQ(record.errors->non_finite, 1);
  EXPECT_TRUE(std::isnan(record.errors->value.relative));
}

// Red if a method's images are written under another's name, or the difference has the wrong sign.
TEST(CompareRunner, ImagesOnDiskAreTheMethodsOwn) {
  Comparison comparison;
  comparison.add(make_exact_method());
  comparison.add(make_ten_percent_method());
  comparison.run();
  const std::filesystem::path out = comparison.options.out;
  const auto mean = [&](const std::string& method, const std::string& what) {
    double sum = 0.0;
    for (const glm::vec3& p : read_exr(image_file(out, method, what)).pixels) {
      sum += static_cast<double>(p.x + p.y + p.z);
    }
    return sum;
  };
  EXPECT_NEAR(mean("ten_percent", "total") / mean("exact", "total"), 1.1, 1e-4);
  EXPECT_NEAR(mean("ten_percent", "difference"),
              mean("ten_percent", "total") - mean("ten_percent", "reference"), 1e-3);
  EXPECT_NEAR(mean("exact", "reference"),
              mean("exact", "reference_direct") + mean("exact", "reference_indirect"), 1e-3);
  EXPECT_EQ(mean("exact", "reference"), mean("ten_percent", "reference"));
}

// Red if --bounces is ignored, or a method is set against paths it does not carry without a word.
TEST(CompareRunner, AReferenceWithOtherBouncesIsSaid) {
  Comparison comparison;
  comparison.add(make_exact_method());
  comparison.options.bounces = "1..4";
  const RunRecord record = comparison.run().front();
  EXPECT_NE(record.light_paths, record.reference_paths);
  ASSERT_FALSE(record.warnings.empty());
  EXPECT_NE(record.warnings.back().find("does not simulate"), std::string::npos);
  EXPECT_LT(record.errors->value.bias, -0.01);  // light of more bounces is missing
}

// Red if a knob of one method reaches another, or defaults are lost.
TEST(CompareRunner, KnobsReachTheirMethodOnly) {
  Comparison comparison;
  comparison.add(make_exact_method());
  comparison.add(make_ten_percent_method());
  comparison.options.settings = {"ten_percent.size=7"};
  const ComparePlan plan = make_plan(comparison.options, comparison.methods);
  EXPECT_EQ(plan.methods[0].knobs.integer("size"), 3);
  EXPECT_EQ(plan.methods[1].knobs.integer("size"), 7);
  EXPECT_NE(command_line(plan, "omni", plan.methods).find("--set ten_percent.size=7"), std::string::npos);
}

}  // namespace
}  // namespace relight::test
