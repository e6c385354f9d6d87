// Checkpoints: an interrupted run goes on as if nothing had happened, and nothing wrong is ever taken for it.
#include <cstring>
#include <fstream>

#include <tbb/global_control.h>

#include "reference/path_tracer_state.h"
#include "tests/reference/class_scene.h"
#include "tests/run/error_message.h"
#include "tests/run/temporary_folder.h"

namespace relight::tiny {
namespace {

namespace fs = std::filesystem;

bool same_bits(const Image& a, const Image& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

void expect_same_bits(const PathTracerResult& a, const PathTracerResult& b) {
  EXPECT_TRUE(same_bits(a.indirect, b.indirect));
  EXPECT_TRUE(same_bits(a.indirect_variance, b.indirect_variance));
  EXPECT_EQ(a.batches, b.batches);
  EXPECT_EQ(a.samples_per_pixel, b.samples_per_pixel);
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.fireflies, b.fireflies);
  EXPECT_EQ(a.relative_standard_error, b.relative_standard_error);
  ASSERT_EQ(a.layers.size(), b.layers.size());
  for (size_t i = 0; i < a.layers.size(); ++i) {
    EXPECT_TRUE(same_bits(a.layers[i].mean, b.layers[i].mean)) << a.layers[i].path_class.name();
    EXPECT_TRUE(same_bits(a.layers[i].variance, b.layers[i].variance)) << a.layers[i].path_class.name();
  }
}

std::string read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

// 8 batches of 32 samples: enough for the planning of paths a tile.
PathTracerSettings long_run() {
  PathTracerSettings s = settings(Estimator::light_vertex, 256, 8, all_paths(0, 3));
  s.class_bounces = 1;
  return s;
}

struct Killed {};

// Red if (each tried): planning is done anew after a resume, batches count from 0 again, or the state comes
// back without its planned paths or its layers.
TEST(Checkpoint, ResumedRunGivesTheBitsOfAnUninterruptedOne) {
  const TemporaryFolder folder;
  const Rendering render(full_scene(), 13, 9);
  const PathTracerResult whole = render(local, long_run());
  for (const int stop : {1, 3, 7}) {
    PathTracerSettings s = long_run();
    s.checkpoint = {folder.path() / ("after_" + std::to_string(stop)), "room", 0.0};
    int batches = 0;
    // The third batch is lost: it ends before its checkpoint is written.
    s.on_batch = [&](const ConvergencePoint&) {
      if (++batches == stop + 1) throw Killed();
    };
    {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
      EXPECT_THROW(render(local, s), Killed);
    }
    ASSERT_EQ(load_state(s.checkpoint.file, "room")->batches, stop);
    s.on_batch = nullptr;
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
    expect_same_bits(render(local, s), whole);
  }
}

// The number of samples changes nothing but when to stop, as long as a batch has as many and both runs plan.
// Red if (both tried): the state is that of the last batch but one, or a finished one is rendered anew.
TEST(Checkpoint, AddingSamplesEqualsOneLongerRun) {
  const TemporaryFolder folder;
  const Rendering render(full_scene(), 8, 6);
  PathTracerSettings s = long_run();
  s.checkpoint = {folder.path() / "state", "room", 1e9};
  s.samples_per_pixel = 128, s.batches = 4;
  const PathTracerResult half = render(local, s);
  s.on_batch = [](const ConvergencePoint&) { ADD_FAILURE() << "nothing is left to render"; };
  const PathTracerResult again = render(local, s);
  s.on_batch = nullptr;
  expect_same_bits(again, half);
  s.samples_per_pixel = 256, s.batches = 8;
  expect_same_bits(render(local, s), render(local, long_run()));
  s.samples_per_pixel = 128, s.batches = 4;
  EXPECT_EQ(render(local, s).batches, 8) << "a longer state is not cut";
}

// Red if (tried): time of earlier sessions is forgotten, so that a limit starts anew.
TEST(Checkpoint, KeepsTheTimeSpent) {
  const TemporaryFolder folder;
  const Rendering render(full_scene(), 8, 6);
  PathTracerSettings s = long_run();
  s.checkpoint = {folder.path() / "state", "room", 1e9};
  render(local, s);
  PathTracerState state = *load_state(s.checkpoint.file, "room");
  EXPECT_GT(state.seconds, 0.0);
  EXPECT_GE(render(local, s).seconds, state.seconds);
  state.seconds = 1000.0;
  save_state(s.checkpoint.file, "room", state);
  s.samples_per_pixel *= 2, s.batches *= 2, s.time_limit_s = 500.0;
  EXPECT_EQ(render(local, s).batches, 8) << "the limit was over before";
}

PathTracerState small_state() {
  PathTracerState state;
  state.batches = 3, state.rays = 12345678901, state.non_finite = 2, state.seconds = 1.5;
  state.paths = {1, 4, 2};
  state.pixels.resize(5);
  state.pixels[2] = {glm::dvec3(1, 2, 3), glm::dvec3(0.1, 0.2, 0.3), 7.0};
  state.layers.resize(10);
  state.layers[9].mean.y = -0.5;
  return state;
}

// Red if: a field is left out of the file (tried: non_finite).
TEST(Checkpoint, FileHoldsTheWholeState) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "made" / "on the way" / "state";
  save_state(file, "a key\nof two lines", small_state());
  const PathTracerState a = small_state(), b = *load_state(file, "a key\nof two lines");
  EXPECT_EQ(std::tie(a.batches, a.rays, a.non_finite, a.seconds, a.paths),
            std::tie(b.batches, b.rays, b.non_finite, b.seconds, b.paths));
  EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(PixelStatistics)), 0);
  ASSERT_EQ(b.pixels.size(), 5u);
  ASSERT_EQ(b.layers.size(), 10u);
  EXPECT_EQ(std::memcmp(a.layers.data(), b.layers.data(), a.layers.size() * sizeof(PixelStatistics)), 0);
  EXPECT_FALSE(load_state(folder.path() / "missing", "").has_value());
}

// Red if (tried): the key is not compared.
TEST(Checkpoint, OfAnotherRunIsRefusedAndKept) {
  const TemporaryFolder folder;
  const Rendering render(full_scene(), 8, 6);
  PathTracerSettings s = settings(Estimator::next_event, 8, 2);
  s.checkpoint = {folder.path() / "state.rt", "seed 1", 0.0};
  render(local, s);
  const std::string before = read_bytes(s.checkpoint.file);
  s.checkpoint.key = "seed 2";
  const std::string message = error_message([&] { render(local, s); });
  for (const char* part : {"state.rt", "seed 1", "seed 2", "another run"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(read_bytes(s.checkpoint.file), before);
}

// A key that forgot the size of the picture or the classes must not crash. Red if (tried): sizes are not
// compared.
TEST(Checkpoint, OfAnotherSizeIsRefused) {
  const TemporaryFolder folder;
  PathTracerSettings s = settings(Estimator::next_event, 8, 2);
  s.checkpoint = {folder.path() / "state.rt", "", 0.0};
  Rendering(full_scene(), 8, 6)(local, s);
  const Rendering larger(full_scene(), 9, 6), same(full_scene(), 8, 6);
  EXPECT_NE(error_message([&] { larger(local, s); }).find("state.rt"), std::string::npos);
  s.class_bounces = 1;
  EXPECT_NE(error_message([&] { same(local, s); }).find("state.rt"), std::string::npos);
}

// Every truncation, every single changed byte, and bytes too many. Red if (both tried): the checksum is not
// compared, or what follows it is not looked at.
TEST(Checkpoint, DamagedFilesAreRefusedNamingThem) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "state.rt";
  save_state(file, "key", small_state());
  const std::string good = read_bytes(file);
  const auto expect_refused = [&](const std::string& bytes, size_t at) {
    write_bytes(file, bytes);
    const std::string message = error_message([&] { load_state(file, "key"); });
    EXPECT_NE(message.find("state.rt"), std::string::npos) << at << ": " << message;
  };
  for (size_t size = 0; size < good.size(); ++size) expect_refused(good.substr(0, size), size);
  for (size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x20);
    expect_refused(bad, at);
  }
  expect_refused(good + "x", good.size());
  write_bytes(file, good);
  EXPECT_TRUE(load_state(file, "key").has_value());
}

// Red if (tried): the version is not looked at.
TEST(Checkpoint, OfAnotherVersionIsRefused) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "state.rt";
  save_state(file, "key", small_state());
  std::string bytes = read_bytes(file);
  const size_t version = bytes.find('\n') - 1;
  bytes[version] = static_cast<char>(bytes[version] + 1);
  write_bytes(file, bytes);
  const std::string message = error_message([&] { load_state(file, "key"); });
  EXPECT_NE(message.find("state.rt"), std::string::npos) << message;
  EXPECT_NE(message.find("this version"), std::string::npos) << message;
}

// A process killed while it wrote, or before it renamed, leaves a temporary file beside the last good state.
// Red if (tried): the state is written in place.
TEST(Checkpoint, KilledWhileWritingLosesNothing) {
  const TemporaryFolder folder;
  const Rendering render(full_scene(), 8, 6);
  PathTracerSettings s = settings(Estimator::next_event, 16, 4);
  const PathTracerResult whole = render(local, s);
  s.checkpoint = {folder.path() / "state.rt", "room", 0.0};
  PathTracerSettings part = s;
  part.samples_per_pixel = 8, part.batches = 2;
  render(local, part);
  const std::string bytes = read_bytes(s.checkpoint.file);
  for (const char* leftover : {"state.1-0.tmp.rt", "state.99999-7.tmp.rt"})
    write_bytes(folder.path() / leftover, bytes.substr(0, bytes.size() / 2));
  expect_same_bits(render(local, s), whole);

  // Whoever holds the old file keeps the old bytes: the new ones were not written over them.
  const fs::path held = folder.path() / "held.rt";
  fs::create_hard_link(s.checkpoint.file, held);
  const std::string old_bytes = read_bytes(held);
  save_state(s.checkpoint.file, "room", small_state());
  EXPECT_EQ(read_bytes(held), old_bytes);
  EXPECT_NE(read_bytes(s.checkpoint.file), old_bytes);

  // The new state can't take the old one's place: the old one stays, whole, and the run says so.
  const fs::path target = folder.path() / "folder.rt";
  fs::create_directories(target / "inside");
  const std::string message = error_message([&] { save_state(target, "room", small_state()); });
  EXPECT_NE(message.find("folder.rt"), std::string::npos) << message;
  EXPECT_TRUE(fs::exists(target / "inside"));
}

}  // namespace
}  // namespace relight::tiny
