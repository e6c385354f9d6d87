// Everything a stored picture depends on, in words and exact decimal numbers. A stored picture whose identity
// differs from what the list and the program say today is stale: it shows something else, and comparing with
// it would prove nothing.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiments/session/session.h"
#include "experiments/stored_references/list.h"
#include "experiments/stored_references/picture_statistics.h"

namespace relight {

// The session that renders `reference`.
SessionOptions stored_session_options(const StoredReference& reference);
BatchPlan stored_plan(const StoredReference& reference);

// Scene with content hash, lights, camera, view, light paths, estimator, samples, seed, reference version.
nlohmann::ordered_json picture_identity(const StoredReference& reference, const Session& session);

// One line a field that differs: "scene_hash: stored X, now Y"; empty if the picture is what it should be.
std::vector<std::string> stale_fields(const nlohmann::ordered_json& stored,
                                      const nlohmann::ordered_json& now);

}  // namespace relight
