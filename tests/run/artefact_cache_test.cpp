#include "common/run/artefact_cache.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/run/error_message.h"
#include "tests/run/full_disk.h"
#include "tests/run/temporary_folder.h"

namespace relight {
namespace {

std::vector<std::byte> example_data(size_t bytes = 1000) {
  std::vector<std::byte> data(bytes);
  for (size_t i = 0; i < bytes; ++i) data[i] = static_cast<std::byte>(i * 37 % 251);
  return data;
}

size_t files_in(const std::filesystem::path& folder) {
  size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

std::filesystem::path only_file(const ArtefactCache& cache) {
  EXPECT_EQ(files_in(cache.folder()), 1u);
  return std::filesystem::directory_iterator(cache.folder())->path();
}

// Bug: kinds or keys mixed up, an older artefact kept besides (one may have gigabytes), or a file written.
TEST(ArtefactCache, InMemoryKeepsTheLastOfEachKind) {
  const ArtefactCache cache = ArtefactCache::in_memory();
  const ArtefactCache copy = cache;
  cache.store("matrix", "a", example_data(10));
  cache.store("cloud", "a", example_data(20));
  cache.store("matrix", "b", example_data(30));
  EXPECT_EQ(copy.load("matrix", "b"), example_data(30));
  EXPECT_EQ(copy.load("cloud", "a"), example_data(20));
  EXPECT_FALSE(copy.load("matrix", "a"));
  EXPECT_FALSE(copy.load("cloud", "b"));
  EXPECT_TRUE(cache.list().empty());
}

// Bug: data cut, shifted by the header, or empty data taken for a miss.
TEST(ArtefactCache, GivesBackWhatWasStored) {
  const TemporaryFolder folder;
  const ArtefactCache cache(folder.path() / "made" / "by_store", true);
  cache.store("matrix", "scene=a", example_data());
  cache.store("empty", "scene=a", {});
  EXPECT_EQ(cache.load("matrix", "scene=a"), example_data());
  EXPECT_EQ(cache.load("empty", "scene=a"), std::vector<std::byte>());
}

// Bug: key or kind left out of the comparison.
TEST(ArtefactCache, OtherKeysAndKindsAreMisses) {
  const TemporaryFolder folder;
  const ArtefactCache cache(folder.path(), true);
  cache.store("matrix", "scene=a", example_data());
  EXPECT_FALSE(cache.load("matrix", "scene=b"));
  EXPECT_FALSE(cache.load("links", "scene=a"));
}

// Bug: the file name's 64-bit hash taken as proof. A file renamed to another key's name stands for a
// collision.
TEST(ArtefactCache, FileOfAnotherKeyUnderThisKeysNameIsAMiss) {
  const TemporaryFolder folder;
  const ArtefactCache cache(folder.path(), true);
  cache.store("matrix", "scene=a", example_data());
  const auto file_a = only_file(cache);
  const ArtefactCache other(folder.path() / "other", true);
  other.store("matrix", "scene=b", example_data(5));
  std::filesystem::rename(only_file(other), file_a);
  EXPECT_FALSE(cache.load("matrix", "scene=a"));
  EXPECT_EQ(cache.list().size(), 1u);
}

// Bug: any byte not covered by the checks; a damaged length that allocates terabytes. Every byte is flipped
// in turn.
TEST(ArtefactCache, AnyDamagedByteIsAMiss) {
  const TemporaryFolder folder;
  const ArtefactCache cache(folder.path(), true);
  cache.store("k", "key", example_data(100));
  const auto file = only_file(cache);
  const auto size = std::filesystem::file_size(file);
  for (uintmax_t at = 0; at < size; ++at) {
    std::fstream io(file, std::ios::in | std::ios::out | std::ios::binary);
    const auto flip = [&] {
      io.seekg(static_cast<std::streamoff>(at));
      const char old = static_cast<char>(io.get());
      io.seekp(static_cast<std::streamoff>(at));
      io.put(static_cast<char>(old ^ '\x80')).flush();
    };
    flip();
    EXPECT_FALSE(cache.load("k", "key")) << "byte " << at;
    flip();
  }
  EXPECT_EQ(cache.load("k", "key"), example_data(100)) << "undamaged again";
}

// Bug: a file cut by a crash is read as if whole, or its remains block a new store.
TEST(ArtefactCache, CutAndForeignFilesAreMissesAndAreReplaced) {
  const TemporaryFolder folder;
  const ArtefactCache cache(folder.path(), true);
  cache.store("k", "key", example_data());
  const auto file = only_file(cache);
  for (const uintmax_t size : {std::filesystem::file_size(file) - 1, uintmax_t{30}, uintmax_t{0}}) {
    std::filesystem::resize_file(file, size);
    EXPECT_FALSE(cache.load("k", "key")) << size;
  }
  cache.store("k", "key", example_data());
  EXPECT_EQ(cache.load("k", "key"), example_data());
}

// Bug: a full disk leaves a partial or temporary file, or passes in silence.
TEST(ArtefactCache, FullDiskIsAnErrorThatLeavesNothingBehind) {
  const TemporaryFolder folder;
  const ArtefactCache cache(folder.path(), true);
  std::string message;
  {
    const FileSizeLimit limit(100'000);
    message = error_message([&] { cache.store("k", "key", example_data(200'000)); });
  }
  EXPECT_NE(message.find(folder.path().string()), std::string::npos) << message;
  EXPECT_NE(message.find("200000 bytes"), std::string::npos) << message;
  EXPECT_EQ(files_in(folder.path()), 0u);
}

// Bug: --no-cache still reads or writes.
TEST(ArtefactCache, DisabledCacheNeitherReadsNorWrites) {
  const TemporaryFolder folder;
  ArtefactCache(folder.path(), true).store("k", "key", example_data());
  const ArtefactCache disabled(folder.path(), false);
  EXPECT_FALSE(disabled.load("k", "key"));
  disabled.store("k", "other", example_data());
  EXPECT_EQ(files_in(folder.path()), 1u);
}

// Bug: clear() removes a user's own files from a folder that was given by mistake; stale temporaries stay
// forever.
TEST(ArtefactCache, ClearRemovesOnlyItsOwnFiles) {
  const TemporaryFolder folder;
  const ArtefactCache cache(folder.path(), true);
  cache.store("k", "a", example_data());
  cache.store("k", "b", example_data());
  std::ofstream(folder.path() / "thesis.relight") << "years of work";
  std::filesystem::copy_file(cache.list()[0].file, folder.path() / "k-0.1-0.tmp.relight");
  EXPECT_EQ(cache.clear(), 3);
  EXPECT_EQ(only_file(cache).filename(), "thesis.relight");
}

// Bug: list() shows the hash instead of the key, or a wrong size.
TEST(ArtefactCache, ListTellsKindKeyAndSize) {
  const TemporaryFolder folder;
  const ArtefactCache cache(folder.path(), true);
  EXPECT_TRUE(ArtefactCache(folder.path() / "missing", true).list().empty());
  cache.store("some/kind", "the key", example_data());
  const auto entries = cache.list();
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].kind, "some/kind");
  EXPECT_EQ(entries[0].key, "the key");
  EXPECT_EQ(entries[0].bytes, std::filesystem::file_size(entries[0].file));
}

// Bug: the order of the environment variables.
TEST(ArtefactCache, DefaultFolderFollowsTheEnvironment) {
  setenv("HOME", "/home/someone", 1);
  unsetenv("RELIGHT_CACHE"), unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(ArtefactCache::default_folder(), "/home/someone/.cache/relight");
  setenv("XDG_CACHE_HOME", "/var/xdg", 1);
  EXPECT_EQ(ArtefactCache::default_folder(), "/var/xdg/relight");
  setenv("RELIGHT_CACHE", "/fast/disk", 1);
  EXPECT_EQ(ArtefactCache::default_folder(), "/fast/disk");
  unsetenv("RELIGHT_CACHE"), unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace relight
