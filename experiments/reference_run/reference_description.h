// reference.json: what `relight reference` rendered, how, and how sure it is of it.
#pragma once

#include <nlohmann/json.hpp>

#include "common/image/metrics.h"
#include "experiments/session/session.h"
#include "reference/path_tracer.h"

namespace relight {

nlohmann::ordered_json describe_reference(const Session& session, const PathTracerSettings& settings,
                                          const PathTracerResult& result, const ErrorReport& report);

}  // namespace relight
