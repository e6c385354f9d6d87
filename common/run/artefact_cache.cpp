#include "common/run/artefact_cache.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <system_error>

#include "common/run/atomic_file.h"
#include "common/run/error.h"

namespace relight {

namespace {

// File: magic, then 64-bit lengths of kind, key and data, the checksum of all that follows it, kind, key,
// data.
constexpr std::array<char, 8> magic = {'R', 'E', 'L', 'C', 'A', 'C', 'H', '1'};
constexpr const char* extension = ".relight";

struct Header {
  std::array<char, 8> magic;
  uint64_t kind_bytes, key_bytes, data_bytes, checksum;
};
static_assert(sizeof(Header) == 40);

// FNV-1a's step on 64-bit words (bytes would cost 1 s for 500 MB), with a shift so that high bits reach low
// ones. Each step is a bijection of the state: a change within one word is always seen.
uint64_t hash_bytes(const void* data, size_t bytes, uint64_t state = 0xcbf29ce484222325u) {
  constexpr uint64_t prime = 0x100000001b3u;
  const char* at = static_cast<const char*>(data);
  const auto step = [&](uint64_t word) {
    state = (state ^ word) * prime;
    state ^= state >> 32;
  };
  for (; bytes >= 8; bytes -= 8, at += 8) {
    uint64_t word;
    std::memcpy(&word, at, 8);
    step(word);
  }
  for (; bytes > 0; --bytes, ++at) step(static_cast<unsigned char>(*at));
  return state;
}

uint64_t checksum_of(const std::string& kind, const std::string& key, const std::vector<std::byte>& data) {
  const uint64_t of_words = hash_bytes(key.data(), key.size(), hash_bytes(kind.data(), kind.size()));
  return hash_bytes(data.data(), data.size(), of_words);
}

// Kinds come from code, but a slash in one must not leave the folder.
std::string file_name(const std::string& kind, const std::string& key) {
  std::string safe = kind;
  for (char& c : safe)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '_' && c != '-') c = '_';
  return fmt::format("{}-{:016x}{}", safe, hash_bytes(key.data(), key.size()), extension);
}

struct OpenedFile {
  std::ifstream in;
  Header header;
  std::string kind, key;
};

// Reads everything but the data; nothing if the file is not a whole file of this cache.
std::optional<OpenedFile> open_file(const std::filesystem::path& file) {
  std::error_code error;
  const uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size < sizeof(Header)) return {};
  OpenedFile opened{std::ifstream(file, std::ios::binary), {}, {}, {}};
  opened.in.read(reinterpret_cast<char*>(&opened.header), sizeof(Header));
  const Header& header = opened.header;
  if (!opened.in || header.magic != magic) return {};
  // A damaged length must not become a huge allocation. Each part is checked first so that the sum can't
  // wrap.
  if (header.kind_bytes > size || header.key_bytes > size || header.data_bytes > size) return {};
  if (sizeof(Header) + header.kind_bytes + header.key_bytes + header.data_bytes != size) return {};
  opened.kind.resize(header.kind_bytes);
  opened.key.resize(header.key_bytes);
  opened.in.read(opened.kind.data(), static_cast<std::streamsize>(header.kind_bytes));
  opened.in.read(opened.key.data(), static_cast<std::streamsize>(header.key_bytes));
  if (!opened.in) return {};
  return opened;
}

bool has_magic(const std::filesystem::path& file) {
  std::array<char, 8> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  return start == magic;
}

std::vector<std::filesystem::path> regular_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    if (it->is_regular_file(error)) files.push_back(it->path());
  std::sort(files.begin(), files.end());
  return files;
}

void write_parts(const std::filesystem::path& file, const Header& header, const std::string& kind,
                 const std::string& key, const std::vector<std::byte>& data) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&header), sizeof(Header));
  out.write(kind.data(), static_cast<std::streamsize>(kind.size()));
  out.write(key.data(), static_cast<std::streamsize>(key.size()));
  out.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
  out.close();
  if (!out)
    fail("cannot write {} bytes to cache folder '{}': disk full or no permission", data.size(),
         file.parent_path().string());
}

}  // namespace

struct ArtefactCache::Memory {
  struct Kept {
    std::string key;
    std::vector<std::byte> data;
  };
  std::map<std::string, Kept> by_kind;
};

ArtefactCache ArtefactCache::in_memory() {
  ArtefactCache cache({}, true);
  cache.memory_ = std::make_shared<Memory>();
  return cache;
}

ArtefactCache::ArtefactCache(std::filesystem::path folder, bool enabled)
    : folder_(std::move(folder)), enabled_(enabled) {}

std::filesystem::path ArtefactCache::default_folder() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  if (const auto own = variable("RELIGHT_CACHE"); !own.empty()) return own;
  // The XDG base directory specification says that a relative path counts as unset.
  if (const auto xdg = variable("XDG_CACHE_HOME"); xdg.is_absolute()) return xdg / "relight";
  if (const auto home = variable("HOME"); !home.empty()) return home / ".cache" / "relight";
  return std::filesystem::temp_directory_path() / "relight-cache";
}

std::optional<std::vector<std::byte>> ArtefactCache::load(const std::string& kind,
                                                          const std::string& key) const {
  if (!enabled_) return {};
  if (memory_) {
    const auto kept = memory_->by_kind.find(kind);
    if (kept == memory_->by_kind.end() || kept->second.key != key) return {};
    return kept->second.data;
  }
  auto opened = open_file(folder_ / file_name(kind, key));
  if (!opened || opened->kind != kind || opened->key != key) return {};
  std::vector<std::byte> data(opened->header.data_bytes);
  opened->in.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(data.size()));
  if (!opened->in || checksum_of(kind, key, data) != opened->header.checksum) return {};
  return data;
}

void ArtefactCache::store(const std::string& kind, const std::string& key,
                          const std::vector<std::byte>& data) const {
  if (!enabled_) return;
  if (memory_) {
    memory_->by_kind[kind] = {key, data};
    return;
  }
  const Header header{magic, kind.size(), key.size(), data.size(), checksum_of(kind, key, data)};
  write_atomically(folder_ / file_name(kind, key), [&](const std::filesystem::path& temporary) {
    write_parts(temporary, header, kind, key, data);
  });
}

std::vector<ArtefactCache::Entry> ArtefactCache::list() const {
  std::vector<Entry> entries;
  for (const auto& file : regular_files(folder_))
    if (const auto opened = open_file(file))
      entries.push_back({file, opened->kind, opened->key, std::filesystem::file_size(file)});
  return entries;
}

int ArtefactCache::clear() const {
  int removed = 0;
  for (const auto& file : regular_files(folder_)) {
    // Also takes what a killed run left under a temporary name: that starts with the same header.
    if (!has_magic(file)) continue;
    std::error_code error;
    if (!std::filesystem::remove(file, error) || error)
      fail("cannot remove cache file '{}': {}", file.string(), error.message());
    ++removed;
  }
  return removed;
}

}  // namespace relight
