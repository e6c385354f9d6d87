// What it took to make an artefact, kept in the cache beside it: a run that finds the artefact reports the
// stages, counters, bytes and warnings of its making, so that a record does not depend on what was cached.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/run/stage_log.h"

namespace relight {

struct MakingLog {
  StageLog log;
  double seconds = 0.0;  // wall time
};

// What was logged between two states of one log. A stage or artefact that both name is in it if it changed.
StageLog difference(const StageLog& after, const StageLog& before);

std::vector<std::byte> to_bytes(const MakingLog& made);
// Nothing if the bytes are not of a MakingLog.
std::optional<MakingLog> making_log_from_bytes(const std::vector<std::byte>& bytes);

}  // namespace relight
