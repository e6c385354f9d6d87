// Direct-to-indirect transfer on a small view of any scene, for tests that relight it again and again.
#pragma once

#include <unistd.h>

#include <filesystem>

#include "common/hard_cases/method_bench.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "tests/support/image_difference.h"

namespace relight::test {

// 1024 gather samples and a coarse cut of their hierarchy, which is fast, unless the knobs say otherwise.
class TransferBench : public hard::MethodBench {
 public:
  using Knobs = hard::KnobList;

  explicit TransferBench(Scene s, int width = 40, int height = 30)
      : MethodBench(make_direct_to_indirect(), std::move(s),
                    {{"gather_samples", "1024"}, {"link_threshold", "2"}}, width, height) {
    cache = ArtefactCache(folder, true);
  }
  ~TransferBench() { std::filesystem::remove_all(folder); }

  // One precompute for all devices and relight knobs, in whatever order.
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("relight_transfer_bench_" + std::to_string(::getpid()));
};

}  // namespace relight::test
