#include "methods/direct_to_indirect/hard_cases/hard_cases.h"

#include "common/hard_cases/scale_case.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "methods/direct_to_indirect/hard_cases/bench.h"

namespace relight::direct_to_indirect {

hard::Cases hard_cases() {
  hard::Cases all;
  for (const auto& part : {precompute_cases(), glossy_cases(), light_cases(), view_cases(), surface_cases(),
                           environment_cases()})
    all.insert(all.end(), part.begin(), part.end());
  hard::KnobList knobs = fast_knobs();
  knobs.insert(knobs.end(), {{"device", "cpu"}, {"weights", "float32"}});
  all.push_back(
      hard::scale_case(make_direct_to_indirect, knobs, 0.1,
                       "stated: with 1,024 gather samples and coarse links another choice of samples is "
                       "another picture, of the same light"));
  return all;
}

}  // namespace relight::direct_to_indirect
