// `relight run`: the product of lists, refusals before anything starts, resuming, and going on after a
// failure.
#include <set>

#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "common/run/error.h"
#include "experiments/compare/image_files.h"
#include "experiments/run/explain_runs.h"
#include "experiments/run/record_of.h"
#include "experiments/run/run_experiment.h"
#include "experiments/usage_error.h"
#include "fake_methods.h"
#include "program.h"

namespace relight::test {
namespace {

SessionOptions small_session() {
  SessionOptions session;
  session.quiet = true;
  session.no_cache = true;
  return session;
}

MethodList fakes() {
  MethodList methods;
  methods.push_back(make_exact_method());
  methods.push_back(make_ten_percent_method());
  methods.push_back(make_throwing_method("precompute"));
  return methods;
}

struct Trial {
  TemporaryFolder folder;
  MethodList methods = fakes();

  RunList list(const std::string& text) {
    const std::string file = folder / "trial.toml";
    write_text(file, text);
    return make_runs(read_experiment(file), small_session(), methods, folder / "out");
  }
  ExperimentResult run(const RunList& runs, bool again = false) {
    return run_experiment(runs, folder / "out", again);
  }
  std::string message(const std::string& text) {
    try {
      list(text);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }
  size_t records_written() { return read_json_lines(folder / "out/records.jsonl").size(); }
};

const std::string head = "title = 'trial'\nview = '12x9'\nreference_samples = 8\nrepeats = 1\n";

std::string group(const std::string& method, const std::string& more = "") {
  return fmt::format("[[runs]]\nscenes = ['cornell']\nlights = ['omni', 'spot']\nmethod = '{}'\n{}", method,
                     more);
}

// Red if a list is not multiplied out, or a knob of the last group reaches the others.
TEST(RunExperiment, ExpandsListsToTheirProduct) {
  TemporaryFolder folder;
  const std::string file = folder / "product.toml";
  write_text(file,
             "title = 'product'\n[[runs]]\nscenes = ['cornell', 'still_life']\nlights = ['omni', 'spot']\n"
             "method = 'direct_to_indirect'\npresets = ['paper', 'best']\nseeds = [1, 2, 3]\n[runs.knobs]\n"
             "coefficients = [10, 20]\nlink_threshold = [0, 0.02]\nbounces = 2\n");
  const MethodList methods = make_all_methods();
  const RunList list = make_runs(read_experiment(file), small_session(), methods, folder / "out");
  EXPECT_EQ(list.runs.size(), size_t{2 * 2 * 2 * 3 * 2 * 2});
  std::set<std::string> all;
  for (const PlannedRun& run : list.runs) {
    const KnobValues& knobs = run.plan.methods.front().knobs;
    EXPECT_EQ(knobs.integer("bounces"), 2);
    all.insert(describe(run) + knobs.precompute_key());
  }
  EXPECT_EQ(all.size(), list.runs.size());
}

TEST(RunExperiment, RefusesUnknownNamesBeforeAnythingStarts) {
  Trial trial;
  const std::string method = trial.methods.front()->name();
  EXPECT_NE(trial.message(head + group("no_such_method")).find("no_such_method"), std::string::npos);
  EXPECT_NE(trial.message(head + group(method, "presets = ['worst']")).find("'worst'"), std::string::npos);
  EXPECT_NE(trial.message(head + group(method, "[runs.knobs]\nno_knob = 1")).find("no_knob"),
            std::string::npos);
  EXPECT_NE(trial.message(head + group(method, "colour = 1")).find("colour"), std::string::npos);
  EXPECT_NE(trial.message(head).find("[[runs]]"), std::string::npos);
  const std::string unlit = "[[runs]]\nscenes = ['cornell']\nlights = ['moon']\nmethod = '" + method + "'\n";
  EXPECT_NE(trial.message(head + unlit).find("valid presets: near, omni, spot"), std::string::npos);
  const std::string nowhere =
      "[[runs]]\nscenes = ['atlantis']\nlights = ['omni']\nmethod = '" + method + "'\n";
  EXPECT_NE(trial.message(head + nowhere).find("atlantis"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(trial.folder / "out"));
}

TEST(RunExperiment, LeavesOutOptionalScenesThatAreNotThereAndSaysSo) {
  Trial trial;
  const RunList list = trial.list(
      head + "[[runs]]\nscenes = ['atlantis', 'cornell']\nlights = ['omni']\noptional = true\nmethod = '" +
      trial.methods.front()->name() + "'\n");
  EXPECT_EQ(list.runs.size(), 1u);
  ASSERT_EQ(list.left_out.size(), 1u);
  EXPECT_NE(list.left_out.front().find("atlantis"), std::string::npos);
}

// Red if a run is known by less than everything that decides its result, or a torn line stops the rest.
TEST(RunExperiment, GoesOnWhereItStoppedAndEndsWithTheSameRecords) {
  Trial trial;
  const RunList list = trial.list(head + group(trial.methods[0]->name()) + group(trial.methods[1]->name()));
  ASSERT_EQ(list.runs.size(), 4u);
  const ExperimentResult whole = trial.run(list);
  EXPECT_EQ(trial.records_written(), 4u);
  // A machine that lost power while it wrote the third record.
  const std::string file = trial.folder / "out/records.jsonl", text = read_text(file);
  size_t end = 0;
  for (int line = 0; line < 2; ++line) end = text.find('\n', end) + 1;
  write_text(file, text.substr(0, end + 40));
  const ExperimentResult resumed = trial.run(list);
  ASSERT_EQ(resumed.records.size(), whole.records.size());
  for (size_t i = 0; i < whole.records.size(); ++i) {
    EXPECT_EQ(resumed.records[i].command, whole.records[i].command);
    EXPECT_EQ(resumed.records[i].errors->value.relative, whole.records[i].errors->value.relative);
  }
  // Nothing is left to do, unless it is asked for.
  const std::string complete = read_text(file);
  trial.run(list);
  EXPECT_EQ(read_text(file), complete);
  trial.run(list, true);
  EXPECT_NE(read_text(file), complete);
}

// Red if a record is taken for one of another reference, knob, seed or scene.
TEST(RunExperiment, KnowsARecordByEverythingThatDecidesIt) {
  Trial trial;
  const PlannedRun run = trial.list(head + group(trial.methods[0]->name())).runs.front();
  const RunRecord record = trial.run({{run}, {}}).records.front();
  EXPECT_TRUE(is_record_of(record, run));
  PlannedRun other = run;
  other.plan.reference_samples *= 2;
  EXPECT_FALSE(is_record_of(record, other));
  const auto differs = [&](auto change) {
    RunRecord changed = record;
    change(changed);
    return !is_record_of(changed, run);
  };
  EXPECT_TRUE(differs([](RunRecord& r) { r.knobs["another"] = "1"; }));
  EXPECT_TRUE(differs([](RunRecord& r) { r.seed = 2; }));
  EXPECT_TRUE(differs([](RunRecord& r) { r.scene_hash = "0"; }));
  EXPECT_TRUE(differs([](RunRecord& r) { r.lighting = "spot2"; }));
  EXPECT_TRUE(differs([](RunRecord& r) { r.lighting_hash = "0"; })) << "the file's lights were changed";
  EXPECT_TRUE(differs([](RunRecord& r) { r.view_hash = "0"; })) << "the file's camera was changed";
  EXPECT_TRUE(differs([](RunRecord& r) { r.view = "13x9"; }));
  EXPECT_TRUE(differs([](RunRecord& r) { r.method = "another"; }));
}

const std::string moving_scene =
    "base = 'cornell'\n[view.low]\neye = [0.4, 0.5, 3.5]\n[[lighting.sweep]]\ntype = 'omni'\n"
    "position = [0, 1.5, 0]\nintensity = 1\n[[lighting.sweep.keyframe]]\ntime = 0\nintensity = 1\n"
    "[[lighting.sweep.keyframe]]\ntime = 1\nintensity = 3\n";

std::string moving_runs(const std::string& lights, const std::string& method) {
  return fmt::format(
      "title = 'trial'\nviews = ['12x9', 'low:12x9']\nreference_samples = 8\nrepeats = 1\n[[runs]]\n"
      "scenes = ['./moving.toml']\nlights = ['{}']\nmethod = '{}'\n",
      lights, method);
}

// Red if views or moments share a folder, a record or a reference, or a view is not the scene's camera of
// that name; with one moment alone if a session is kept from view to view.
TEST(RunExperiment, RunsOnSeveralViewsAndAlongLightSequences) {
  for (const auto& [lights, runs] :
       {std::pair("sweep@0:1:0.5", size_t{6}), std::pair("sweep@0", size_t{2})}) {
    Trial trial;
    write_text(trial.folder / "moving.toml", moving_scene);
    const RunList list = trial.list(moving_runs(lights, trial.methods[0]->name()));
    ASSERT_EQ(list.runs.size(), runs);
    const ExperimentResult result = trial.run(list);
    EXPECT_TRUE(result.failures.empty());
    std::set<std::string> folders, hashes;
    std::set<float> brightness;
    for (size_t i = 0; i < runs; ++i) {
      folders.insert(folder_name(list.runs[i]));
      const RunRecord& record = result.records[i];
      hashes.insert(record.view_hash + record.lighting_hash);
      const std::filesystem::path images =
          std::filesystem::path(trial.folder / "out") / folder_name(list.runs[i]);
      float sum = 0.0f;
      for (const glm::vec3& p : read_exr(image_file(images, record.method, "reference")).pixels) sum += p.x;
      brightness.insert(sum);
      EXPECT_TRUE(is_record_of(record, list.runs[i]));
    }
    EXPECT_EQ(folders.size(), runs);
    EXPECT_EQ(hashes.size(), runs);
    EXPECT_EQ(brightness.size(), runs);
    EXPECT_EQ(result.records.front().lighting, "sweep@0");
    // A file that is changed has no records any more.
    write_text(trial.folder / "moving.toml", moving_scene + "[camera]\neye = [0, 1, 3.8]\n");
    const RunList changed = trial.list(moving_runs(lights, trial.methods[0]->name()));
    EXPECT_FALSE(is_record_of(result.records.front(), changed.runs.front()));
  }
}

TEST(RunExperiment, RefusesViewsAndMomentsThatDoNotExist) {
  Trial trial;
  write_text(trial.folder / "moving.toml", moving_scene);
  const auto says = [&](const std::string& top, const std::string& lights) {
    return trial.message("title = 't'\n" + top +
                         "[[runs]]\nscenes = ['./moving.toml', 'cornell']\nlights = ['" + lights +
                         "']\nmethod = '" + trial.methods[0]->name() + "'\n");
  };
  EXPECT_NE(says("views = ['high:12x9']\n", "sweep@0").find("valid: low"), std::string::npos);
  EXPECT_NE(says("view = '12x9'\nviews = ['12x9']\n", "sweep@0").find("one of them"), std::string::npos);
  EXPECT_NE(says("", "sweep@1:0:1").find("trial.toml:4"), std::string::npos) << says("", "sweep@1:0:1");
  EXPECT_NE(says("", "spot@1").find("nothing in 'spot' moves"), std::string::npos);
}

TEST(RunExperiment, AFailedRunIsReportedTheOthersGoOnAndItIsTriedAgain) {
  Trial trial;
  const RunList list = trial.list(head + group(trial.methods[2]->name()) + group(trial.methods[0]->name()));
  const ExperimentResult result = trial.run(list);
  EXPECT_EQ(result.failures.size(), 2u);
  EXPECT_NE(result.failures.front().find("broken on purpose"), std::string::npos);
  int good = 0;
  for (const RunRecord& record : result.records) good += record.errors ? 1 : 0;
  EXPECT_EQ(good, 2);
  EXPECT_EQ(trial.records_written(), 4u);
  trial.run(list);
  EXPECT_EQ(trial.records_written(), 6u);
}

// Red if a cell is written under another column's name, or a comma of a failure splits its cell.
TEST(RunExperiment, WritesATableWithAColumnForEachKnobThatVaries) {
  RunRecord a, b;
  a.scene = b.scene = "cornell";
  a.method = b.method = "m";
  a.knobs = {{"x", "1"}, {"y", "5"}};
  b.knobs = {{"x", "2"}, {"y", "5"}};
  b.relight_stages = {{"transfer", 0.25}};
  b.failed_stages = {"relight: broken, twice"};
  const std::string csv = result_csv({a, b});
  EXPECT_NE(csv.find(",m.x,"), std::string::npos);
  EXPECT_EQ(csv.find("m.y"), std::string::npos);
  EXPECT_NE(csv.find("relight.transfer_ms"), std::string::npos);
  EXPECT_NE(csv.find(",250,"), std::string::npos);
  EXPECT_NE(csv.find("\"relight: broken, twice\""), std::string::npos);
}

// Red if an explanation is made twice, or taken for one of other settings, or a method that fails stops the
// others.
TEST(RunExperiment, TakesTheErrorsApartThatTheFileAsksFor) {
  Trial trial;
  const std::string good = group(trial.methods[1]->name(), "explain_pixels = 16\n");
  const RunList list = trial.list(head + group(trial.methods[2]->name(), "explain_pixels = 16\n") + good +
                                  group(trial.methods[0]->name()));
  const std::filesystem::path out = trial.folder / "out";
  const std::vector<size_t> places = runs_to_explain(list, out, false);
  EXPECT_EQ(places.size(), 4u);
  const std::vector<std::string> failures = explain_runs(list, places, out);
  ASSERT_EQ(failures.size(), 2u);
  EXPECT_NE(failures.front().find("broken on purpose"), std::string::npos) << failures.front();
  EXPECT_EQ(runs_to_explain(list, out, false).size(), 2u);
  EXPECT_EQ(runs_to_explain(list, out, true).size(), 4u);
  const RunList more = trial.list(head + group(trial.methods[1]->name(), "explain_pixels = 32\n"));
  EXPECT_EQ(runs_to_explain(more, out, false).size(), 2u);
  const auto json = nlohmann::json::parse(read_text(out / folder_name(more.runs.front()) / "waterfall.json"));
  EXPECT_NEAR(json.at("asked").at("indirect_linear").get<double>(), 0.1, 0.05) << "ten per cent too dark";
  EXPECT_NE(trial.message(head + group(trial.methods[1]->name(), "explain_pixels = 16\ntolerance = '1%'\n"))
                .find("explain_pixels"),
            std::string::npos);
}

TEST(RunCommand, ListsTheRunsOfTheExperimentsInTheRepository) {
  for (const auto& entry : std::filesystem::directory_iterator(RELIGHT_SOURCE_DIR "/experiments")) {
    if (entry.path().extension() != ".toml") continue;
    const ProgramResult result = run_program("run '" + entry.path().string() + "' --dry-run");
    EXPECT_EQ(result.exit_code, 0) << entry.path() << "\n" << result.err;
    EXPECT_NE(result.out.find(" runs, view "), std::string::npos);
  }
}

}  // namespace
}  // namespace relight::test
