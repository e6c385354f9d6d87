#include "common/run/effects.h"

namespace relight {

Effect bounces_effect(const std::string& knob, int most) {
  Effect effect{"bounces", "Bounces of indirect light; 0: direct light alone.", {}};
  for (int n = 0; n <= most; ++n) effect.levels.push_back({std::to_string(n), {{knob, std::to_string(n)}}});
  return effect;
}

Effect switch_effect(const std::string& name, const std::string& sentence, const std::string& knob,
                     const std::string& off, const std::string& on) {
  return {name, sentence, {{"off", {{knob, off}}}, {"on", {{knob, on}}}}};
}

}  // namespace relight
