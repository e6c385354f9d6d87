#include "common/run/run_record.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "common/run/peak_memory.h"
#include "common/run/thread_limit.h"
#include "tests/run/error_message.h"
#include "tests/run/full_disk.h"
#include "tests/run/temporary_folder.h"

namespace relight {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Every field differs from its default and from every other, so that a forgotten or swapped one shows.
RunRecord example_record() {
  RunRecord record;
  record.scene = "cornell", record.view = "front", record.lighting = "\"left\" spot", record.method = "m";
  record.knobs = {{"a", "1"}, {"b", "map"}};
  record.seed = 0xffffffffffffffffu;
  record.light_paths = "E D D L", record.width = 320, record.height = 240;
  record.triangles = 36, record.scene_hash = "abc123";
  record.view_hash = "v1", record.lighting_hash = "l2";
  record.errors = ErrorReport{{1, 2, 3, 4, 5, -6, 0.7, 8},
                              {.1, .2, .3, .4, .5, .6, .7, .8},
                              {.01, .02, .03, .04, .05, .06, .07, .08},
                              0.125,
                              9};
  record.errors_indirect = ErrorReport{{nan, infinity, -infinity, 1.0 / 3.0, 0, 0, 1, 0}, {}, {}, 0, 0};
  record.precompute_s = 12.5, record.relight_ms = {3, 2, 4, 7};
  record.precompute_stages = {{"z_first", 1.0}, {"a_second", 2.0}};
  record.relight_stages = {{"shade", 0.003}};
  record.setup_stages = {{"load", 0.5}};
  record.reference_paths = "E D+ L", record.not_simulated = {"glossy lobes"};
  record.command = "relight compare", record.exposure = 1.75;
  record.memory_bytes = {{"matrix", 5'000'000'000}}, record.counters = {{"rays", 123}};
  record.reference = ReferenceCost{256, 8, 60.5, 99, "light_vertex", true};
  record.warnings = {"one"}, record.failed_stages = {"shade: 2 NaN"};
  record.provenance = {
      "commit", true, "compiler", "Release", "cpu", 2, "llvmpipe", "4.5", "2026-01-31T23:59:59Z", true};
  record.repeatable = false;
  return record;
}

void expect_equal(const MetricSet& a, const MetricSet& b) {
  for (const auto field :
       {&MetricSet::relative, &MetricSet::relative_edges_out, &MetricSet::relative_hdr, &MetricSet::rmse,
        &MetricSet::relmse, &MetricSet::bias, &MetricSet::ssim, &MetricSet::max})
    EXPECT_TRUE(a.*field == b.*field || (std::isnan(a.*field) && std::isnan(b.*field)))
        << a.*field << " " << b.*field;
}

// Bug: a field forgotten on either side, a double cut to 6 digits, a seed through double, stages sorted by
// name, NaN as null (nlohmann's habit).
TEST(RunRecord, SurvivesARoundTrip) {
  const RunRecord record = example_record();
  const std::string line = record_to_json(record);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const RunRecord read = record_from_json(line);
  EXPECT_EQ(record_to_json(read), line);
  EXPECT_EQ(read.scene, "cornell");
  EXPECT_EQ(read.view, "front");
  EXPECT_EQ(read.view_hash, "v1");
  EXPECT_EQ(read.lighting_hash, "l2");
  EXPECT_EQ(read.lighting, "\"left\" spot");
  EXPECT_EQ(read.method, "m");
  EXPECT_EQ(read.knobs, record.knobs);
  EXPECT_EQ(read.seed, 0xffffffffffffffffu);
  EXPECT_EQ(read.light_paths, "E D D L");
  EXPECT_EQ(read.width, 320);
  EXPECT_EQ(read.height, 240);
  EXPECT_EQ(read.triangles, 36);
  EXPECT_FALSE(read.repeatable);
  EXPECT_TRUE(read.provenance.shared_machine);
  EXPECT_EQ(read.scene_hash, "abc123");
  expect_equal(read.errors.value().value, record.errors->value);
  expect_equal(read.errors->noise_floor, record.errors->noise_floor);
  expect_equal(read.errors->half_width, record.errors->half_width);
  EXPECT_EQ(read.errors->edge_share, 0.125);
  EXPECT_EQ(read.errors->non_finite, 9);
  expect_equal(read.errors_indirect.value().value, record.errors_indirect->value);
  EXPECT_EQ(read.precompute_s, 12.5);
  EXPECT_EQ(read.relight_ms.median, 3);
  EXPECT_EQ(read.relight_ms.min, 2);
  EXPECT_EQ(read.relight_ms.max, 4);
  EXPECT_EQ(read.relight_ms.repeats, 7);
  EXPECT_EQ(read.precompute_stages, record.precompute_stages);
  EXPECT_EQ(read.relight_stages, record.relight_stages);
  EXPECT_EQ(read.memory_bytes, record.memory_bytes);
  EXPECT_EQ(read.counters, record.counters);
  EXPECT_EQ(read.reference.value().samples, 256);
  EXPECT_EQ(read.reference->batches, 8);
  EXPECT_EQ(read.reference->seconds, 60.5);
  EXPECT_EQ(read.reference->rays, 99);
  EXPECT_EQ(read.reference->estimator, "light_vertex");
  EXPECT_TRUE(read.reference->from_cache);
  EXPECT_EQ(read.setup_stages, record.setup_stages);
  EXPECT_EQ(read.reference_paths, "E D+ L");
  EXPECT_EQ(read.not_simulated, record.not_simulated);
  EXPECT_EQ(read.command, "relight compare");
  EXPECT_EQ(read.exposure, 1.75);
  EXPECT_EQ(read.warnings, record.warnings);
  EXPECT_EQ(read.failed_stages, record.failed_stages);
  EXPECT_EQ(read.provenance.commit, "commit");
  EXPECT_TRUE(read.provenance.dirty);
  EXPECT_EQ(read.provenance.compiler, "compiler");
  EXPECT_EQ(read.provenance.build_type, "Release");
  EXPECT_EQ(read.provenance.cpu, "cpu");
  EXPECT_EQ(read.provenance.threads, 2);
  EXPECT_EQ(read.provenance.gl_renderer, "llvmpipe");
  EXPECT_EQ(read.provenance.gl_version, "4.5");
  EXPECT_EQ(read.provenance.date, "2026-01-31T23:59:59Z");
}

// Bug: a run without errors reads back as a run with error 0.
TEST(RunRecord, AbsentErrorsStayAbsent) {
  RunRecord record = example_record();
  record.errors.reset(), record.errors_indirect.reset(), record.reference.reset();
  const RunRecord read = record_from_json(record_to_json(record));
  EXPECT_FALSE(read.errors || read.errors_indirect || read.reference);
}

// Bug: the even median takes one of the middle two; unsorted input.
TEST(RunRecord, TimesAreSummarisedByMedianAndExtremes) {
  const RelightTime odd = summarise_times({5, 1, 9}), even = summarise_times({8, 2, 4, 100});
  EXPECT_EQ(odd.median, 5);
  EXPECT_EQ(odd.min, 1);
  EXPECT_EQ(odd.max, 9);
  EXPECT_EQ(odd.repeats, 3);
  EXPECT_EQ(even.median, 6);
  EXPECT_EQ(even.max, 100);
  EXPECT_EQ(summarise_times({}).repeats, 0);
}

// Bug: append truncates, or writes without newline.
TEST(RunRecord, AppendedRecordsAreReadInOrder) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "new_folder" / "records.jsonl";
  RunRecord record = example_record();
  for (const uint64_t seed : {1u, 2u, 3u}) record.seed = seed, append_record(file, record);
  const RecordFile read = read_records(file);
  EXPECT_TRUE(read.warnings.empty());
  ASSERT_EQ(read.records.size(), 3u);
  EXPECT_EQ(read.records[0].seed, 1u);
  EXPECT_EQ(read.records[2].seed, 3u);
}

// Bug: two processes tear each other's lines (buffered stream, no lock). Descriptors are separate, as in
// processes.
TEST(RunRecord, ConcurrentAppendsKeepEveryLineWhole) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "records.jsonl";
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) append_record(file, example_record());
    });
  for (auto& thread : threads) thread.join();
  const RecordFile read = read_records(file);
  EXPECT_EQ(read.records.size(), 200u);
  EXPECT_TRUE(read.warnings.empty());
}

// Bug: one torn line costs the whole file, or swallows the next record.
TEST(RunRecord, ATornLineCostsOnlyItself) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "records.jsonl";
  append_record(file, example_record());
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 20);
  append_record(file, example_record());
  const RecordFile read = read_records(file);
  EXPECT_EQ(read.records.size(), 1u);
  ASSERT_EQ(read.warnings.size(), 1u);
  EXPECT_NE(read.warnings[0].find("records.jsonl:1:"), std::string::npos) << read.warnings[0];
}

// Bug: a full disk leaves half a line, or passes in silence.
TEST(RunRecord, FullDiskLeavesTheFileAsItWas) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "records.jsonl";
  append_record(file, example_record());
  const auto size = std::filesystem::file_size(file);
  {
    const FileSizeLimit limit(size + 10);
    EXPECT_THROW(append_record(file, example_record()), Error);
  }
  EXPECT_EQ(std::filesystem::file_size(file), size);
}

// Bug: a mistyped record crashes with a foreign exception, or the message does not name the field.
TEST(RunRecord, MissingFieldsAreNamed) {
  const std::string message = error_message([] { record_from_json("{\"scene\": \"a\"}"); });
  EXPECT_NE(message.find("view"), std::string::npos) << message;
  EXPECT_THROW(record_from_json("not json"), Error);
  EXPECT_THROW(read_records("/does/not/exist.jsonl"), Error);
}

// Bug: a placeholder instead of the build's commit; local time labelled Z; threads of the machine, not of the
// limit.
TEST(Provenance, TellsCommitThreadsAndDate) {
  const ThreadLimit limit(1);
  const Provenance provenance = collect_provenance("renderer", "4.5");
  const bool is_hash = provenance.commit.size() == 40 &&
                       provenance.commit.find_first_not_of("0123456789abcdef") == std::string::npos;
  EXPECT_TRUE(is_hash || provenance.commit == "unknown") << provenance.commit;
  EXPECT_EQ(provenance.threads, 1);
  EXPECT_EQ(provenance.gl_renderer, "renderer");
  EXPECT_EQ(provenance.gl_version, "4.5");
  EXPECT_FALSE(provenance.compiler.empty() || provenance.cpu.empty() || provenance.build_type.empty());
  std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char today[32];
  std::strftime(today, sizeof today, "%Y-%m-%dT%H:", &utc);
  // Seconds before a full hour the two clocks may differ.
  if (utc.tm_min < 59) {
    EXPECT_EQ(provenance.date.substr(0, 14), today);
  }
  ASSERT_EQ(provenance.date.size(), 20u) << provenance.date;
  EXPECT_EQ(provenance.date.back(), 'Z');
}

// Bug: kibibytes reported as bytes, or the current size instead of the peak.
TEST(PeakMemory, RemembersMemoryThatWasGivenBack) {
  const int64_t before = peak_memory_bytes();
  constexpr size_t bytes = 200'000'000;
  {
    std::vector<char> touched(bytes, 1);
    EXPECT_EQ(touched.back(), 1);
  }
  EXPECT_GT(peak_memory_bytes(), before + static_cast<int64_t>(bytes) * 3 / 4);
  EXPECT_LT(peak_memory_bytes(), 100 * static_cast<int64_t>(bytes));
}

}  // namespace
}  // namespace relight
