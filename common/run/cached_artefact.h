// A method's precomputed data from the cache, or made and stored: the one way in which methods use it.
#pragma once

#include <string>

#include "common/run/artefact_cache.h"
#include "common/run/error.h"
#include "common/run/method.h"

namespace relight {

// Scene (by its content), view and seed in words: the part of a cache key that is the same for every method.
std::string view_words(const PrepareContext& context);

// The same with the pixels that are asked for.
std::string pixel_words(const PrepareContext& context);

// make() -> Artefact; to_bytes(Artefact) -> bytes; from_bytes(bytes) -> Artefact. Logs stages cache_load and
// cache_store and counter cache_hits. A cache that cannot be written costs a warning, not the run.
template <typename Make, typename ToBytes, typename FromBytes>
auto load_or_make(const PrepareContext& context, const std::string& kind, const std::string& key, Make make,
                  ToBytes to_bytes, FromBytes from_bytes) {
  {
    StageTimer timer(context.log, "cache_load");
    if (const auto bytes = context.cache.load(kind, key)) {
      context.log.count("cache_hits", 1);
      return from_bytes(*bytes);
    }
  }
  auto artefact = make();
  StageTimer timer(context.log, "cache_store");
  try {
    if (context.cache.enabled()) context.cache.store(kind, key, to_bytes(artefact));
  } catch (const Error& error) {
    context.log.warn(std::string("precomputed data was not cached: ") + error.what());
  }
  return artefact;
}

}  // namespace relight
