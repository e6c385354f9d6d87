// Clustered gather on a small view of any scene, for tests that relight it again and again.
#pragma once

#include "common/hard_cases/method_bench.h"
#include "methods/clustered_gather/clustered_gather.h"
#include "tests/support/image_difference.h"

namespace relight::test {

using Knobs = hard::KnobList;

// Few clusters and directions unless the knobs say otherwise.
struct GatherBench : hard::MethodBench {
  explicit GatherBench(Scene s, int width = 40, int height = 30)
      : MethodBench(make_clustered_gather(), std::move(s),
                    {{"view_clusters", "200"}, {"directions", "100"}, {"gather_clusters", "16"}}, width,
                    height) {}
};

}  // namespace relight::test
