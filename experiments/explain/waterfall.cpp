#include "experiments/explain/waterfall.h"

#include <cmath>

#include "common/run/error.h"

namespace relight {
namespace {

class Arithmetic {
 public:
  explicit Arithmetic(const WaterfallInput& in) : in_(in) {
    if (std::isnan(share(sums(in.reference, in.reference, Measure::relative))) ||
        std::isnan(share(sums(in.reference, in.reference, Measure::indirect_linear))))
      fail(
          "explain-error: the reference is black on the chosen pixels, so there is no relative error; choose "
          "other lights or more pixels");
  }

  Measures error(const Picture& a) const { return change(a, in_.reference); }
  Measures change(const Picture& a, const Picture& b) const {
    Measures out;
    for (size_t m = 0; m < measure_count; ++m) out[m] = share(sums(a, b, static_cast<Measure::Kind>(m)));
    return out;
  }
  // Of error(from) - error(to), or of error(from).
  Measures half_width(const Picture& from, const Picture* to) const {
    Measures out;
    for (size_t m = 0; m < measure_count; ++m) {
      const auto measure = static_cast<Measure::Kind>(m);
      out[m] = half_width_of_drop(sums(from, in_.reference, measure),
                                  to ? sums(*to, in_.reference, measure) : BlockSums{});
    }
    return out;
  }

 private:
  BlockSums sums(const Picture& a, const Picture& b, Measure::Kind measure) const {
    return block_sums(a, b, in_.reference, in_.layout, measure);
  }
  const WaterfallInput& in_;
};

Measures minus(const Measures& a, const Measures& b) {
  Measures out;
  for (size_t m = 0; m < measure_count; ++m) out[m] = a[m] - b[m];
  return out;
}

WaterfallRow stage_row(const Arithmetic& arithmetic, const StageResults& stage, const SettingResult& before,
                       const SettingResult& all_exact) {
  WaterfallRow row;
  row.name = stage.stage.name, row.sentence = stage.stage.sentence;
  row.active = stage.exact.has_value();
  if (!row.active) return row;
  const Picture& after = stage.exact->picture;
  row.points = minus(arithmetic.error(before.picture), arithmetic.error(after));
  row.half_width = arithmetic.half_width(before.picture, &after);
  row.change = arithmetic.change(before.picture, after);
  row.relight_saved_ms = stage.exact->relight_ms - before.relight_ms;
  row.precompute_saved_s = stage.exact->precompute_s - before.precompute_s;
  row.alone_points = minus(arithmetic.error(stage.alone->picture), arithmetic.error(all_exact.picture));
  row.alone_change = arithmetic.change(stage.alone->picture, all_exact.picture);
  return row;
}

}  // namespace

Waterfall make_waterfall(const WaterfallInput& in) {
  const Arithmetic arithmetic(in);
  Waterfall out;
  out.asked = arithmetic.error(in.asked.picture);
  out.asked_half_width = arithmetic.half_width(in.asked.picture, nullptr);
  const SettingResult* all_exact = &in.asked;
  for (const StageResults& stage : in.stages)
    if (stage.exact) all_exact = &*stage.exact;
  const SettingResult* before = &in.asked;
  for (const StageResults& stage : in.stages) {
    out.stages.push_back(stage_row(arithmetic, stage, *before, *all_exact));
    if (stage.exact) before = &*stage.exact;
  }
  out.remainder.name = in.remainder, out.remainder.sentence = in.remainder_sentence;
  out.remainder.points = out.remainder.change = arithmetic.error(all_exact->picture);
  out.remainder.half_width = arithmetic.half_width(all_exact->picture, nullptr);
  for (const auto& [stage, result] : in.closer)
    out.closer.emplace_back(stage.name, arithmetic.error(result.picture));
  return out;
}

Measures sum_of_points(const Waterfall& waterfall) {
  Measures sum = waterfall.remainder.points;
  for (const WaterfallRow& row : waterfall.stages)
    for (size_t m = 0; m < measure_count; ++m) sum[m] += row.points[m];
  return sum;
}

}  // namespace relight
