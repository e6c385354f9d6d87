#include "common/run/knobs.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/run/error_message.h"

namespace relight {
namespace {

KnobTable example_table() {
  return {
      {"samples", KnobType::integer, KnobPhase::precompute, "64", 1, 1000, {}, "gather", "Samples."},
      {"clamp", KnobType::real, KnobPhase::precompute, "0.1", 0, 1, {}, "gather", "Clamp."},
      {"shadows", KnobType::choice, KnobPhase::relight, "map", 0, 0, {"map", "traced"}, "shade", "Shadows."},
      {"antialias", KnobType::boolean, KnobPhase::relight, "true", 0, 0, {}, "shade", "Antialias."}};
}

// Bug: values start empty, or a getter parses with the wrong type.
TEST(Knobs, StartAtTheirDefaults) {
  const KnobValues knobs(example_table());
  EXPECT_EQ(knobs.integer("samples"), 64);
  EXPECT_EQ(knobs.real("clamp"), 0.1);
  EXPECT_EQ(knobs.choice("shadows"), "map");
  EXPECT_TRUE(knobs.boolean("antialias"));
}

// Bug: an unknown name is added in silence, or the message leaves the user guessing.
TEST(Knobs, UnknownNameFailsWithTheValidNames) {
  KnobValues knobs(example_table());
  const std::string message = error_message([&] { knobs.set("sampels", "3"); });
  EXPECT_EQ(message, "unknown knob 'sampels'; valid knobs: samples, clamp, shadows, antialias");
}

// Bug: a bound taken as exclusive, or off by one.
TEST(Knobs, BothEndsOfTheRangeAreValid) {
  KnobValues knobs(example_table());
  knobs.set("samples", "1");
  EXPECT_EQ(knobs.integer("samples"), 1);
  knobs.set("samples", "1000");
  EXPECT_EQ(knobs.integer("samples"), 1000);
  knobs.set("clamp", "0");
  knobs.set("clamp", "1");
  EXPECT_EQ(knobs.real("clamp"), 1.0);
}

// Bug: no range check, or a message without name, value and range.
TEST(Knobs, ValueOutOfRangeNamesKnobValueAndRange) {
  KnobValues knobs(example_table());
  EXPECT_EQ(error_message([&] { knobs.set("samples", "1001"); }),
            "knob 'samples': 1001 is out of range; valid range: 1 to 1000");
  EXPECT_EQ(error_message([&] { knobs.set("clamp", "-0.5"); }),
            "knob 'clamp': -0.5 is out of range; valid range: 0 to 1");
  EXPECT_EQ(knobs.integer("samples"), 64) << "a rejected value must not be kept";
}

// Bug: std::stoi-like parsing that reads "12abc" as 12, "1.5" as 1, "" as 0, or lets nan through every
// comparison.
TEST(Knobs, TextThatIsNotWhollyANumberIsRejected) {
  KnobValues knobs(example_table());
  for (const char* text : {"", " 12", "12abc", "1.5", "nan", "99999999999999999999"})
    EXPECT_THROW(knobs.set("samples", text), Error) << "'" << text << "'";
  for (const char* text : {"", "0.5x", "nan", "inf", "0,5"})
    EXPECT_THROW(knobs.set("clamp", text), Error) << "'" << text << "'";
}

// Bug: choices compared by prefix or not at all.
TEST(Knobs, UnknownChoiceFailsWithTheValidChoices) {
  KnobValues knobs(example_table());
  EXPECT_EQ(error_message([&] { knobs.set("shadows", "ma"); }),
            "knob 'shadows': 'ma' is not a valid choice; valid: map, traced");
  EXPECT_EQ(error_message([&] { knobs.set("antialias", "yes please"); }),
            "knob 'antialias': 'yes please' is not a valid value; valid: true, false");
}

// Bug: the text is kept as typed, so that equal values miss each other's cache entry.
TEST(Knobs, EqualValuesHaveOneKey) {
  KnobValues a(example_table()), b(example_table());
  a.set("samples", "010"), a.set("clamp", "5e-1");
  b.set("samples", "10"), b.set("clamp", "0.50");
  EXPECT_EQ(a.precompute_key(), b.precompute_key());
  EXPECT_EQ(a.precompute_key(), "clamp=0.5;samples=10;");
}

// Bug: relight knobs in the key cost a precompute each; a precompute knob left out reuses wrong data.
TEST(Knobs, OnlyPrecomputeKnobsChangeTheKey) {
  const KnobValues defaults(example_table());
  KnobValues changed(example_table());
  changed.set("shadows", "traced"), changed.set("antialias", "off");
  EXPECT_EQ(changed.precompute_key(), defaults.precompute_key());
  changed.set("clamp", "0.2");
  EXPECT_NE(changed.precompute_key(), defaults.precompute_key());
}

// Bug: a typo in code reads a default instead of failing.
TEST(Knobs, GettersRejectWrongNamesAndTypes) {
  const KnobValues knobs(example_table());
  EXPECT_THROW(knobs.integer("sample"), std::logic_error);
  EXPECT_THROW(knobs.real("samples"), std::logic_error);
  EXPECT_THROW(knobs.choice("clamp"), std::logic_error);
}

// Bug: a table with an invalid default is found only by the user who touches the knob.
TEST(Knobs, TablesWithInvalidDefaultsOrTwiceTheSameNameAreRejected) {
  KnobTable invalid = example_table();
  invalid[0].default_value = "0";
  EXPECT_THROW(KnobValues{invalid}, std::logic_error);
  KnobTable twice = example_table();
  twice.push_back(twice[0]);
  EXPECT_THROW(KnobValues{twice}, std::logic_error);
}

}  // namespace
}  // namespace relight
