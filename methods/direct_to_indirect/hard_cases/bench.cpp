#include "methods/direct_to_indirect/hard_cases/bench.h"

#include "common/hard_cases/image_difference.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"

namespace relight::direct_to_indirect {

using namespace hard;

MethodBench transfer_bench(Scene scene) {
  return {make_direct_to_indirect(), std::move(scene), fast_knobs(), 40, 30};
}

RelitByBoth relit_by_both(MethodBench& bench, const Light& light) {
  const LightingState lighting{"hard case", {light}};
  RelitByBoth relit{bench.relight({{"device", "cpu"}, {"weights", "float32"}}, lighting), {}};
  size_t warnings = bench.relight_log.warnings().size();
  const Relit oracle = bench.relight({{"device", "oracle"}, {"shadows", "traced"}}, lighting);
  warnings += bench.relight_log.warnings().size();
  constexpr double bound = 6e-6;
  const char* why = "100 roundings of 2^-24: the sums of a row of 100 coefficients in float";
  relit.figures = {non_finite_pixels({&relit.cpu.total, &oracle.total}),
                   at_most("warnings", static_cast<double>(warnings), 0.0,
                           "a value that was replaced is told by a warning"),
                   at_most("direct light, float against double",
                           relative_difference(relit.cpu.direct, oracle.direct), bound, why),
                   at_most("indirect light, float against double",
                           relative_difference(relit.cpu.indirect, oracle.indirect), bound, why)};
  return relit;
}

}  // namespace relight::direct_to_indirect
