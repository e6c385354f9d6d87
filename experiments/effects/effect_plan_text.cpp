#include <fmt/format.h>

#include "experiments/effects/plan_effects.h"
#include "experiments/options/text_table.h"

namespace relight {

namespace {

std::string interval(const LossInterval& loss) {
  if (loss.high == 0.0) return "0";
  return fmt::format("{:.3g} [{:.3g}, {:.3g}]", 100.0 * loss.value, 100.0 * loss.low, 100.0 * loss.high);
}

std::string settings(const EffectDecision& d) {
  std::string text;
  for (const auto& [knob, value] : d.settings)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", knob, value);
  return text.empty() ? "-" : text;
}

std::string check_text(const EffectPlan& plan) {
  const EffectCheck& check = *plan.check;
  std::string text = fmt::format(
      "measured ({} paths a pixel, {:.1f} s): the plan loses {} %: tolerance {}; predicted {} %: {}\n",
      check.samples, check.seconds, interval(check.measured), to_string(check.verdict), interval(plan.loss),
      check.as_predicted ? "as predicted" : "NOT as predicted");
  if (const auto& all = check.everything)
    text += fmt::format(
        "everything on: precompute {:.2f} s (planned {:.2f} s), relight {:.1f} ms ({:.1f} ms), {:.1f} MB "
        "({:.1f} "
        "MB); its picture differs from the planned one by {:.3g} %\n",
        all->precompute_s, all->planned_precompute_s, all->relight_ms, all->planned_relight_ms,
        1e-6 * static_cast<double>(all->bytes), 1e-6 * static_cast<double>(all->planned_bytes),
        100.0 * all->picture_change);
  return text;
}

}  // namespace

std::string effect_plan_text(const EffectPlan& plan) {
  const bool measured = plan.check.has_value();
  std::vector<std::string> header = {"effect", "level", "of", "by", "settings", "loses %"};
  if (measured) header.push_back("measured %");
  header.push_back("why");
  TextTable table(header);
  for (const EffectDecision& d : plan.effects) {
    std::vector<std::string> row = {d.effect,        d.level,     d.everything,
                                    to_string(d.by), settings(d), interval(d.loss)};
    if (measured) row.push_back(d.measured ? interval(*d.measured) : "-");
    row.push_back(d.reason);
    table.add_row(row);
  }
  std::string text = table.to_string();
  for (const LightNote& l : plan.lights) text += fmt::format("light '{}': {}\n", l.light, l.note);
  text += fmt::format("tolerance {:.3g} %; the whole plan loses {} % of everything ({})\n",
                      100.0 * plan.tolerance, interval(plan.loss), plan.everything);
  if (plan.beyond && plan.beyond->high > 0.0)
    text += fmt::format("more bounces than everything has would be {} % of the picture\n",
                        interval(*plan.beyond));
  text += plan.pilot_samples > 0
              ? fmt::format("planned in {:.2f} s: pilot of {}x{} pixels, {} paths a pixel, {:.1f} M rays\n",
                            plan.seconds, plan.pilot_width, plan.pilot_height, plan.pilot_samples,
                            1e-6 * static_cast<double>(plan.pilot_rays))
              : fmt::format("planned in {:.2f} s by rules alone\n", plan.seconds);
  if (measured) text += check_text(plan);
  for (const std::string& w : plan.warnings) text += fmt::format("warning: {}\n", w);
  return text;
}

}  // namespace relight
