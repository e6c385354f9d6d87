// Where a search goes from a knob's value.
#include <gtest/gtest.h>

#include "experiments/method_list.h"
#include "experiments/tune/knob_steps.h"

namespace relight {
namespace {

Knob knob(KnobType type, KnobTuning tuning, double min = 0, double max = 1e6) {
  return {"k", type, KnobPhase::relight, "1", min, max, {}, "stage", "A knob.", std::move(tuning)};
}

std::string next(const Knob& k, const std::string& value, Direction direction) {
  return next_value(k, value, direction).value_or("none");
}

constexpr Direction cheaper = Direction::cheaper, dearer = Direction::dearer;

// Red if a step leaves the range, or stands still.
TEST(KnobSteps, FactorsStayWithinTheRangeWorthTrying) {
  const Knob k = knob(KnobType::integer, tuned_by_factor(4, 1024, 262144));
  EXPECT_EQ(next(k, "65536", dearer), "262144");
  EXPECT_EQ(next(k, "262144", dearer), "none");
  EXPECT_EQ(next(k, "4096", cheaper), "1024");
  EXPECT_EQ(next(k, "2048", cheaper), "1024");
  EXPECT_EQ(next(k, "1024", cheaper), "none");
  EXPECT_EQ(next(knob(KnobType::integer, tuned_by_factor(1.6, 1, 32)), "1", dearer), "2");
  EXPECT_EQ(next(knob(KnobType::integer, tuned_by_factor(1.2, 1, 32)), "2", cheaper), "1");
}

// 0 outside of the range is "all": the dearest. Red if it is multiplied.
TEST(KnobSteps, FromAllOneCanOnlyGetCheaper) {
  const Knob coefficients = knob(KnobType::integer, tuned_by_factor(2, 10, 1000));
  EXPECT_EQ(next(coefficients, "0", dearer), "none");
  EXPECT_EQ(next(coefficients, "0", cheaper), "1000");
  const Knob threshold = knob(KnobType::real, tuned_by_factor(2, 0.005, 2, false));
  EXPECT_EQ(next(threshold, "0", cheaper), "0.005");
  EXPECT_EQ(next(threshold, "0.02", cheaper), "0.04");
  EXPECT_EQ(next(threshold, "0.02", dearer), "0.01");
}

TEST(KnobSteps, SumsAreWrittenAsPeopleWould) {
  const Knob k = knob(KnobType::real, tuned_by_adding(0.2, 0, 1));
  EXPECT_EQ(next(k, "0.6", dearer), "0.8");
  EXPECT_EQ(next(k, "0.2", cheaper), "0");
  EXPECT_EQ(next(k, "0", cheaper), "none");
}

TEST(KnobSteps, ChoicesGoInOrderAndKnowOnlyThoseWorthTrying) {
  const Knob k = knob(KnobType::choice, tuned_by_choice({"8", "16", "float32"}));
  EXPECT_EQ(next(k, "16", cheaper), "8");
  EXPECT_EQ(next(k, "16", dearer), "float32");
  EXPECT_EQ(next(k, "float32", dearer), "none");
  EXPECT_EQ(next(k, "exact", cheaper), "none");
  EXPECT_EQ(next(knob(KnobType::integer, {}), "16", dearer), "none");
}

// Every method's table: each step of a tuned knob is a valid value, and an idle knob names another knob. Red
// if a choice is misspelt.
TEST(KnobSteps, OfEveryMethodLeadToValidValues) {
  for (const auto& method : make_all_methods()) {
    const KnobTable table = method->knobs();
    int tuned = 0;
    for (const Knob* k : tunable_knobs(table)) {
      ++tuned;
      KnobValues values(table);
      for (const std::string& choice : k->tuning.choices)
        EXPECT_NO_THROW(values.set(k->name, choice)) << k->name;
      for (const Direction direction : {cheaper, dearer}) {
        std::string value = k->default_value;
        for (int i = 0; i < 40; ++i) {
          const auto to = next_value(*k, value, direction);
          if (!to) break;
          ASSERT_NO_THROW(values.set(k->name, *to)) << k->name;
          ASSERT_LT(i, 39) << k->name << " never ends";
          value = *to;
        }
      }
      if (!k->tuning.idle_knob.empty()) {
        EXPECT_EQ(values.all().count(k->tuning.idle_knob), 1u) << k->name;
      }
      for (const std::string& idle_value : k->tuning.idle_values)
        EXPECT_NO_THROW(values.set(k->tuning.idle_knob, idle_value)) << k->name;
    }
    EXPECT_GE(tuned, 2) << method->name();
  }
}

}  // namespace
}  // namespace relight
