#include "common/shading/kept_environment.h"

#include "common/run/error.h"
#include "common/sampling/environment_samples.h"

namespace relight {

bool KeptEnvironment::gives_light(const Environment& environment) const {
  if (off_ || environment.black()) return false;
  if (!prepared_)
    fail(
        "{}.environment: 'auto' found no light from an environment when it precomputed, and this lighting "
        "has some; "
        "valid here: on, off",
        method_);
  return true;
}

bool KeptEnvironment::is_kept(const Environment& environment) const {
  return same_environment(environment_, environment);
}

}  // namespace relight
