// relight cache list | clear
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"
#include "experiments/options/text_table.h"
#include "experiments/session/session.h"

namespace relight::cli {

namespace {

int list_cache(const SessionOptions& options) {
  const ArtefactCache cache = open_cache(options);
  const auto entries = cache.list();
  TextTable table({"kind", "bytes", "key"});
  uintmax_t bytes = 0;
  for (const auto& entry : entries) {
    table.add_row({entry.kind, std::to_string(entry.bytes), entry.key});
    bytes += entry.bytes;
  }
  if (!entries.empty()) fmt::print("{}", table.to_string());
  fmt::print("{}: {} files, {:.1f} MB\n", cache.folder().string(), entries.size(),
             static_cast<double>(bytes) * 1e-6);
  return 0;
}

int clear_cache(const SessionOptions& options) {
  const ArtefactCache cache = open_cache(options);
  const int removed = cache.clear();
  fmt::print("{}: {} files removed\n", cache.folder().string(), removed);
  return 0;
}

}  // namespace

void add_cache_command(Command& app, Action& action) {
  Command* command = app.add_subcommand("cache", "Precomputed data kept on disk");
  command->require_subcommand(1);
  const auto options = std::make_shared<SessionOptions>();
  Command* list = command->add_subcommand("list", "Kind, size and key of every file in the cache");
  Command* clear = command->add_subcommand("clear", "Remove every file of the cache (and nothing else)");
  add_cache_folder_flag(*list, *options);
  add_cache_folder_flag(*clear, *options);
  list->callback([&action, options] { action = [options] { return list_cache(*options); }; });
  clear->callback([&action, options] { action = [options] { return clear_cache(*options); }; });
}

}  // namespace relight::cli
