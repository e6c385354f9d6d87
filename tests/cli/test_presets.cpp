// Presets: named choices of knob values.
#include <gtest/gtest.h>

#include "experiments/compare/plan.h"
#include "experiments/usage_error.h"
#include "fake_methods.h"

namespace relight::test {
namespace {

// Red if the preset is not looked up, or is applied after the settings (both tried).
TEST(Presets, StandBetweenDefaultsAndSettings) {
  const auto method = make_nan_method();  // size 3, preset "big" 7
  EXPECT_EQ(plan_method(*method, {}).knobs.integer("size"), 3);
  EXPECT_EQ(plan_method(*method, {}, "big").knobs.integer("size"), 7);
  EXPECT_EQ(plan_method(*method, {{method->name(), "size", "9"}}, "big").knobs.integer("size"), 9);
}

TEST(Presets, UnknownNameListsTheValidOnes) {
  const auto method = make_nan_method();
  EXPECT_NO_THROW(require_preset("paper", {}));
  EXPECT_NO_THROW(require_preset("big", {method.get()}));
  try {
    require_preset("huge", {method.get()});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("paper, big"), std::string::npos) << error.what();
  }
}

// Red if a preset of any method names a knob that its table lacks, or a value out of range.
TEST(Presets, OfEveryMethodAreValidValues) {
  for (const auto& method : make_all_methods())
    for (const KnobPreset& preset : method->presets()) {
      EXPECT_NE(preset.name, "paper") << method->name();
      EXPECT_FALSE(preset.help.empty());
      const KnobValues knobs = plan_method(*method, {}, preset.name).knobs;
      for (const auto& [knob, value] : preset.values) EXPECT_EQ(knobs.all().at(knob), value) << knob;
    }
}

}  // namespace
}  // namespace relight::test
