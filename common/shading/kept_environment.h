// Of which environment a method keeps the light: what it sends is computed again only when it changes, as
// with lights (light_cache.h).
#pragma once

#include <string>

#include "common/lights/environment.h"
#include "common/run/knobs.h"

namespace relight {

class KeptEnvironment {
 public:
  // knobs: environment (auto, off, on). prepared: has the method precomputed what it takes?
  KeptEnvironment(std::string method, const KnobValues& knobs, bool prepared)
      : method_(std::move(method)), off_(knobs.choice("environment") == "off"), prepared_(prepared) {}

  // True if light comes from the environment; calls compute(environment) first unless it is the one whose
  // light is kept. Throws Error for an environment that isn't black and that nothing was precomputed for,
  // unless the knob says off.
  template <typename Compute>
  bool update(const Environment& environment, Compute compute) {
    if (!gives_light(environment)) return false;
    if (valid_ && is_kept(environment)) return true;
    valid_ = false;  // stays so if the computation fails
    compute(environment);
    environment_ = environment;
    valid_ = true;
    return true;
  }
  void forget() { valid_ = false; }

 private:
  bool gives_light(const Environment& environment) const;
  bool is_kept(const Environment& environment) const;

  std::string method_;
  bool off_, prepared_, valid_ = false;
  Environment environment_;
};

}  // namespace relight
