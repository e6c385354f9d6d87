// Direct-to-indirect transfer on a small view of any scene.
#pragma once

#include <string>

#include "common/hard_cases/hard_case.h"
#include "common/hard_cases/method_bench.h"
#include "common/lights/light.h"

namespace relight::direct_to_indirect {

// 1024 gather samples and a coarse cut of their hierarchy.
inline hard::KnobList fast_knobs() { return {{"gather_samples", "1024"}, {"link_threshold", "2"}}; }

// kind: of multi_bounce; of so few photons that it takes a blink.
inline hard::KnobList four_bounces(const std::string& kind) {
  return {{"device", "cpu"},      {"weights", "float32"}, {"bounces", "4"},
          {"multi_bounce", kind}, {"photons", "20000"},   {"photon_neighbours", "50"}};
}

// The method with fast_knobs(), 40x30 pixels.
hard::MethodBench transfer_bench(Scene scene);

// Relit on the CPU in float and by the double-precision oracle with traced shadows. Figures: pixels that are
// not finite, warnings, and how far the CPU's picture is from the oracle's.
struct RelitByBoth {
  Relit cpu;
  hard::Figures figures;
};
RelitByBoth relit_by_both(hard::MethodBench& bench, const Light& light);

}  // namespace relight::direct_to_indirect
