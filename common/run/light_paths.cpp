#include "common/run/light_paths.h"

#include <fmt/format.h>

namespace relight {

std::string LightPaths::to_string() const {
  const char* eye = glossy_at_eye ? "(D|G)" : "D";
  const char* interior = glossy_interior ? "(D|G)" : "D";
  std::string sources = "local lights";
  if (environment) sources += ", environment";
  if (environment && last_environment_bounce() != max_bounces)
    sources += fmt::format(" ({})", last_environment_bounce() == 0
                                        ? "direct light alone"
                                        : fmt::format("at most {} bounces", last_environment_bounce()));
  if (emission) sources += ", emission";
  if (max_bounces < min_bounces) return fmt::format("E {} L, direct light alone, {}", eye, sources);
  if (min_bounces == 1 && max_bounces == 1)
    return fmt::format("E {} {} L, 1 bounce, {}", eye, interior, sources);
  return fmt::format("E {} {}+ L, {}..{} bounces, {}", eye, interior, min_bounces, max_bounces, sources);
}

}  // namespace relight
