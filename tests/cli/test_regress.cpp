// The rules of `relight regress`, on records made for it, and its exit codes.
#include <cmath>

#include <gtest/gtest.h>

#include "experiments/regress/publish.h"
#include "experiments/regress/regress.h"
#include "program.h"

namespace relight::test {
namespace {

RunRecord example() {
  RunRecord r;
  r.scene = "scenes/hall.toml", r.view = "64x48", r.lighting = "spot", r.method = "m", r.preset = "paper";
  r.knobs = {{"size", "3"}};
  r.seed = 1;
  r.scene_hash = "abc", r.light_paths = r.reference_paths = "E D D L";
  ErrorReport errors;
  errors.value = {0.05, 0.04, 0.06, 0.01, 0.002, -0.01, 0.98, 0.5};
  errors.half_width = {0.001, 0.001, 0.001, 0.0002, 0.0001, 0.002, 0.005, 0.1};
  r.errors = r.errors_indirect = errors;
  r.precompute_s = 2.0, r.relight_ms = {10.0, 9.0, 15.0, 5};
  r.relight_stages = {{"shade", 0.004}, {"transfer", 0.006}};
  r.counters = {{"links", 1000}, {"rays", 5000}};
  r.memory_bytes = {{"matrix", 4096}, {"process_peak", 100}};
  r.provenance.commit = std::string(40, 'a');
  r.provenance.cpu = "CPU A", r.provenance.threads = 2, r.provenance.build_type = "Release";
  return r;
}

// The weight of `what` after `change` of the fresh record: "change", "note" or "same".
template <typename Function>
std::string after(const std::string& what, Function change, const RunRecord& published = example()) {
  RunRecord fresh = published;
  change(fresh);
  for (const Change& found : find_changes(published, fresh, {}))
    if (found.what == what) return found.weight == Weight::note ? "note" : "change";
  return "same";
}

// Red if half widths are not added up, or the sign of the move decides.
TEST(RegressRules, AnErrorChangesBeyondTheIntervalsOfBoth) {
  const auto by = [](double move) {
    return after("relative", [=](RunRecord& r) { r.errors->value.relative += move; });
  };
  EXPECT_EQ(by(0.0), "same");
  EXPECT_EQ(by(1e-8), "same") << "the rounding of published numbers";
  EXPECT_EQ(by(0.0019), "note");
  EXPECT_EQ(by(0.0021), "change");
  EXPECT_EQ(by(-0.0021), "change") << "what is published no longer describes the build";
  EXPECT_EQ(by(NAN), "change");
  EXPECT_EQ(after("indirect bias", [](RunRecord& r) { r.errors_indirect->value.bias -= 0.03; }), "change");
  EXPECT_EQ(after("indirect bias", [](RunRecord& r) { r.errors->value.bias -= 0.03; }), "same");
}

// Red if a changed camera passes for a changed method, or records from before hashes count as changed.
TEST(RegressRules, ChangedLightsOrCameraAreNamedAndExplainTheRest) {
  RunRecord published = example();
  const auto move_light = [](RunRecord& r) { r.lighting_hash = "new", r.errors->value.relative = 0.5; };
  EXPECT_EQ(after("lights", move_light, published), "same");
  published.lighting_hash = "old";
  EXPECT_EQ(after("lights", move_light, published), "change");
  EXPECT_EQ(after("relative", move_light, published), "same") << "explained by the lights";
}

TEST(RegressRules, CountersAndBytesAreExactOnOneMachine) {
  EXPECT_EQ(after("count.links", [](RunRecord& r) { r.counters["links"] += 1; }), "change");
  EXPECT_EQ(after("count.links", [](RunRecord& r) { r.counters.erase("links"); }), "change");
  EXPECT_EQ(after("count.blocks", [](RunRecord& r) { r.counters["blocks"] = 0; }), "change");
  EXPECT_EQ(after("bytes.matrix", [](RunRecord& r) { r.memory_bytes["matrix"] += 4; }), "change");
  EXPECT_EQ(after("count.cache_hits", [](RunRecord& r) { r.counters["cache_hits"] = 1; }), "same");
  EXPECT_EQ(after("bytes.process_peak", [](RunRecord& r) { r.memory_bytes["process_peak"] = 9; }), "same");
  const auto elsewhere = [](int64_t links) {
    return [=](RunRecord& r) { r.provenance.cpu = "CPU B", r.counters["links"] = links; };
  };
  EXPECT_EQ(after("count.links", elsewhere(1001)), "note");
  EXPECT_EQ(after("count.links", elsewhere(1002)), "change");
}

// Red if one slow repeat makes a change, one lucky repeat hides one, or times of two machines are compared.
TEST(RegressRules, TimesChangeByTheRatioOfMedianAndFastest) {
  const auto with = [](double median, double min) {
    return after("relight", [=](RunRecord& r) { r.relight_ms = {median, min, 100.0, 5}; });
  };
  EXPECT_EQ(with(12.9, 11.6), "same");
  EXPECT_EQ(with(13.1, 11.8), "change");
  EXPECT_EQ(with(13.1, 9.0), "same") << "the machine was busy";
  EXPECT_EQ(with(5.0, 4.0), "note") << "faster";
  EXPECT_EQ(after("precompute", [](RunRecord& r) { r.precompute_s = 2.7; }), "change");
  const auto slow_and = [](auto change) {
    return after("relight", [=](RunRecord& r) {
      r.relight_ms = {100.0, 100.0, 100.0, 5};
      change(r.provenance);
    });
  };
  EXPECT_EQ(slow_and([](Provenance&) {}), "change");
  EXPECT_EQ(slow_and([](Provenance& p) { p.cpu = "CPU B"; }), "same");
  EXPECT_EQ(slow_and([](Provenance& p) { p.threads = 4; }), "same");
  EXPECT_EQ(slow_and([](Provenance& p) { p.shared_machine = true; }), "same");
}

TEST(RegressRules, OtherScenesAndPathsAreSaidInsteadOfTheirErrors) {
  const auto other = [](RunRecord& r) { r.scene_hash = "xyz", r.errors->value.relative = 1.0; };
  EXPECT_EQ(after("scene content", other), "change");
  EXPECT_EQ(after("relative", other), "same");
  EXPECT_EQ(after("light paths", [](RunRecord& r) { r.light_paths = "E D L"; }), "change");
}

TEST(RegressRules, AFailureIsAChangeUnlessItWasPublished) {
  const auto fails = [](RunRecord& r) { r.failed_stages = {"relight: broken"}; };
  RunRecord failed = example();
  fails(failed);
  EXPECT_EQ(after("failed", fails), "change");
  EXPECT_EQ(after("failed", fails, failed), "note");
  EXPECT_EQ(after(
                "failed", [](RunRecord& r) { r.failed_stages.clear(); }, failed),
            "change");
}

// A picture of a time budget has other samples each time.
TEST(RegressRules, PicturesOfATimeBudgetMayDifferAsTimesMay) {
  RunRecord budget = example();
  budget.repeatable = false;
  const auto worse = [](double factor) {
    return [=](RunRecord& r) { r.errors->value.relative *= factor, r.counters["rays"] /= 2; };
  };
  EXPECT_EQ(after("relative", worse(1.2), budget), "same");
  EXPECT_EQ(after("count.rays", worse(1.2), budget), "same");
  EXPECT_EQ(after("relative", worse(1.4), budget), "change");
  const auto elsewhere = [&](RunRecord& r) { worse(3.0)(r), r.provenance.cpu = "CPU B"; };
  EXPECT_EQ(after("relative", elsewhere, budget), "same");
}

// Red if runs are paired by their place in the file, or a run that is gone passes for the same.
TEST(Regress, FindsRunsThatAreMissingOrNewWhateverTheirOrder) {
  RunRecord a = example(), b = example(), c = example();
  b.knobs["size"] = "4", c.knobs["size"] = "5";
  c.errors->value.relative = 0.5;
  const Regression swapped = compare_results("x", {a, b}, {b, a}, {});
  EXPECT_TRUE(swapped.good());
  const Regression regression = compare_results("x", {a, b}, {c, a}, {});
  ASSERT_EQ(regression.runs.size(), 3u);
  EXPECT_EQ(regression.runs[0].verdict, Verdict::same);
  EXPECT_EQ(regression.runs[1].verdict, Verdict::missing);
  EXPECT_EQ(regression.runs[2].verdict, Verdict::added);
  EXPECT_FALSE(regression.good());
  EXPECT_NE(regression.runs[1].run.find("size=4"), std::string::npos) << regression.runs[1].run;
  EXPECT_TRUE(compare_results("x", {a}, {a, c}, {}).good()) << "a new run is no fault";
}

// A method that learned a knob, and a scene file started from another folder.
TEST(Regress, PairsRunsOverNewKnobsAndFolders) {
  RunRecord fresh = example();
  fresh.knobs["colour"] = "red";
  fresh.scene = "/elsewhere/scenes/hall.toml";
  const Regression regression = compare_results("x", {example()}, {fresh}, {});
  ASSERT_EQ(regression.runs.size(), 1u);
  EXPECT_EQ(regression.runs[0].verdict, Verdict::same);
  EXPECT_NE(regression_text(regression).find("knob colour is new, red"), std::string::npos);
}

// Red if a number that is compared is lost, or a folder of the machine is published.
TEST(Publish, KeepsWhatIsComparedAndNoFolders) {
  RunRecord record = example();
  record.errors->value.relative = 1.0 / 3.0;
  record.command = "relight compare --out /home/somebody";
  record.warnings = {"/home/somebody/scene.obj: repaired"};
  const std::string line = published_line(record);
  EXPECT_EQ(line.find("somebody"), std::string::npos);
  EXPECT_NE(line.find("0.3333333,"), std::string::npos) << line;
  const auto changes = find_changes(record_from_json(line), record, {});
  EXPECT_TRUE(changes.empty()) << changes.front().words;
}

// Red if waterfalls stay behind, or whatever else lies in the folder of a run is published.
TEST(Publish, TakesTheWaterfallsOfRunsAlong) {
  TemporaryFolder folder;
  const std::filesystem::path out = folder / "out", results = folder / "results";
  append_record(out / "records.jsonl", example());
  std::filesystem::create_directories(out / "hall_spot_m_paper");
  std::filesystem::create_directories(out / "hall_omni_m_paper");
  write_text(out / "hall_spot_m_paper/waterfall.csv", "kind,stage\n");
  write_text(out / "hall_spot_m_paper/waterfall.json", "{}");
  EXPECT_NE(publish(out, results).find("1 waterfalls"), std::string::npos);
  EXPECT_EQ(read_text(results / "waterfalls/hall_spot_m_paper.csv"), "kind,stage\n");
  size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(results))
    files += entry.is_regular_file();
  EXPECT_EQ(files, 3u) << "records, table and one waterfall";
}

struct Command {
  TemporaryFolder folder;
  void write(const std::string& out, const std::vector<RunRecord>& records) const {
    for (const RunRecord& r : records)
      append_record(std::filesystem::path(folder / out) / "records.jsonl", r);
  }
  ProgramResult regress(const std::string& more = "") const {
    return run_program("regress '" + (folder / "out/x") + "' --results '" + (folder / "results") + "' " +
                       more);
  }
};

TEST(RegressCommand, ExitCodesTellSameChangedAndMistakes) {
  const Command command;
  EXPECT_EQ(command.regress().exit_code, 2) << "nothing was run";
  RunRecord changed = example();
  changed.counters["links"] = 7;
  command.write("out/x", {changed, example()});
  EXPECT_EQ(command.regress().exit_code, 2) << "nothing is published";
  ASSERT_EQ(
      run_program("publish '" + (command.folder / "out/x") + "' '" + (command.folder / "results/x") + "'")
          .exit_code,
      0);
  const ProgramResult same = command.regress();
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_NE(same.out.find("SAME"), std::string::npos);
  EXPECT_EQ(read_json_lines(command.folder / "results/x/records.jsonl").size(), 1u) << "the latest alone";
  command.write("out/x", {changed});
  const ProgramResult other = command.regress("--html '" + (command.folder / "page.html") + "'");
  EXPECT_EQ(other.exit_code, 1) << other.out;
  EXPECT_NE(other.out.find("count.links: 1000 -> 7"), std::string::npos) << other.out;
  EXPECT_NE(read_text(command.folder / "page.html").find("count.links"), std::string::npos);
  EXPECT_EQ(command.regress("--time-tolerance 0.5").exit_code, 2);
}

// Without a folder everything published is asked for; what was not run is missing, not the same.
TEST(RegressCommand, AnExperimentThatWasNotRunIsMissing) {
  const Command command;
  command.write("results/never_run", {example()});
  const ProgramResult result = run_program("regress --results '" + (command.folder / "results") + "'");
  EXPECT_EQ(result.exit_code, 1) << result.out;
  EXPECT_NE(result.out.find("not run"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace relight::test
