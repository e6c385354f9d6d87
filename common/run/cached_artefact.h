// A method's precomputed data from the cache, or made and stored: the one way in which methods use it.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "common/run/artefact_cache.h"
#include "common/run/error.h"
#include "common/run/making_log.h"
#include "common/run/method.h"

namespace relight {

// Scene (by its content), view and seed in words: the part of a cache key that is the same for every method.
std::string view_words(const PrepareContext& context);

// The same with the pixels that are asked for.
std::string pixel_words(const PrepareContext& context);

// make() -> Artefact; to_bytes(Artefact) -> bytes; from_bytes(bytes) -> Artefact. Logs stages cache_load and
// cache_store, counter cache_hits, and what making the artefact logged, now or when it was made
// (making_log.h): an artefact without that counts as a miss. A cache that cannot be written costs a warning,
// not the run.
template <typename Make, typename ToBytes, typename FromBytes>
auto load_or_make(const PrepareContext& context, const std::string& kind, const std::string& key, Make make,
                  ToBytes artefact_to_bytes, FromBytes from_bytes) {
  const std::string log_kind = kind + ".log";
  {
    StageTimer timer(context.log, "cache_load");
    const auto log_bytes = context.cache.load(log_kind, key);
    const auto made = log_bytes ? making_log_from_bytes(*log_bytes) : std::nullopt;
    if (const auto bytes = made ? context.cache.load(kind, key) : std::nullopt) {
      context.log.count("cache_hits", 1);
      context.log.add(made->log);
      return from_bytes(*bytes);
    }
  }
  const StageLog before = context.log;
  const auto start = std::chrono::steady_clock::now();
  auto artefact = make();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const MakingLog made{difference(context.log, before), seconds};
  StageTimer timer(context.log, "cache_store");
  try {
    // The log first: a process that is killed in between leaves no artefact without one.
    if (context.cache.enabled()) context.cache.store(log_kind, key, to_bytes(made));
    if (context.cache.enabled()) context.cache.store(kind, key, artefact_to_bytes(artefact));
  } catch (const Error& error) {
    context.log.warn(std::string("precomputed data was not cached: ") + error.what());
  }
  return artefact;
}

}  // namespace relight
