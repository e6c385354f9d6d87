// Which approximation costs how much of the error: the arithmetic of `relight explain-error`, on pictures
// that are already there.
//
// With A_0 the method as asked, A_k the same with the first k active stages exact, A_n with all of them and R
// the reference, stage k costs e(A_k-1) - e(A_k) points of relative error, and e(A_n) is left for the
// remainder: the points add up to e(A_0) by construction. Norms of differences don't: they are given besides,
// as |A_k-1 - A_k| / |R|, because a stage can change a picture a lot without its error.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/run/error_stages.h"
#include "experiments/explain/measures.h"

namespace relight {

// What one setting gave.
struct SettingResult {
  Picture picture;
  double precompute_s = 0.0;  // what all settings share left out
  double relight_ms = 0.0;    // median
};

struct StageResults {
  ErrorStage stage;
  // For an active stage only: with it and all before it exact, and with all stages exact but it.
  std::optional<SettingResult> exact, alone;
};

struct WaterfallInput {
  SettingResult asked;
  std::vector<StageResults> stages;
  std::string remainder, remainder_sentence;
  std::vector<std::pair<ErrorStage, SettingResult>> closer;  // all stages exact, and closer to the reference
  Picture reference;
  PictureLayout layout;
};

struct WaterfallRow {
  std::string name, sentence;
  bool active = true;
  Measures points{};        // share of e(A_0) [1], signed
  Measures half_width{};    // of points, 95 %, over the choice of pixels
  Measures change{};        // |A_k-1 - A_k| / |R|
  Measures alone_points{};  // e(all exact but this) - e(A_n)
  Measures alone_change{};  // |all exact but this - A_n| / |R|
  // What the approximation saves against its twin on these pixels, everything before it exact. Nothing where
  // the stage is not active or, for the precompute, has relight knobs only.
  std::optional<double> precompute_saved_s, relight_saved_ms;
};

struct Waterfall {
  Measures asked{}, asked_half_width{};  // e(A_0)
  std::vector<WaterfallRow> stages;
  WaterfallRow remainder;                                // its `change` is |A_n - R| / |R|; nothing alone
  std::vector<std::pair<std::string, Measures>> closer;  // e of each, to be compared with the remainder
};

// Throws Error if the reference is black on these pixels: no relative error exists.
Waterfall make_waterfall(const WaterfallInput& input);

// Sum of all stages and the remainder: equal to `asked` to rounding.
Measures sum_of_points(const Waterfall& waterfall);

}  // namespace relight
