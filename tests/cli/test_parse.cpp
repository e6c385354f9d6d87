// The small languages of the command line.
#include <gtest/gtest.h>

#include "experiments/options/parse.h"
#include "experiments/options/text_table.h"
#include "experiments/usage_error.h"

namespace relight {
namespace {

// Red if width and height are swapped.
TEST(Parse, ViewIsWidthTimesHeight) {
  const ViewChoice size = parse_view("640x480");
  EXPECT_EQ(size.width, 640);
  EXPECT_EQ(size.height, 480);
  EXPECT_EQ(size.camera, "");
  EXPECT_EQ(to_string(parse_view("gallery:64x048")), "gallery:64x48");
}

// Red if the last moment of a sequence is lost to rounding, or a name that holds an '@' is cut.
TEST(Parse, LightsAreANameWithOneMomentOrASequence) {
  EXPECT_EQ(parse_lights("spot").name, "spot");
  EXPECT_TRUE(parse_lights("spot").times.empty());
  EXPECT_EQ(parse_lights("sweep@0.5").times, (std::vector<double>{0.5}));
  EXPECT_EQ(parse_lights("sweep@0:0.3:0.1").times.size(), 4u);
  EXPECT_EQ(parse_lights("sweep@0:0.3:0.1").name, "sweep");
  EXPECT_EQ(lights_at("sweep", 0.1 + 0.2), "sweep@0.3");
  for (const char* text : {"me@home", "a@", "a@1:", "a@1:2", "@1", "a@nan"})
    EXPECT_EQ(parse_lights(text).name, text);
  for (const char* text : {"a@1:0:1", "a@0:1:0", "a@0:1:-1", "a@0:1:1e-9"})
    EXPECT_THROW(parse_lights(text), UsageError) << text;
}

// Red if trailing text, signs, zero or huge sides pass (std::stoi would accept "12abc").
TEST(Parse, ViewRefusesEverythingElse) {
  for (const char* text : {"", "x", "640", "640x", "x480", "640x480x3", "640X480", "-4x4", "0x4", "4x0",
                           "12abcx4", "4 x4", "99999x4", "99999999999999x4", ":4x4", "a:4", "a:b:4x4"}) {
    EXPECT_THROW(parse_view(text), UsageError) << text;
  }
}

// Red if a single number is not a range of one.
TEST(Parse, BouncesAreARangeOrOneNumber) {
  EXPECT_EQ(to_string(parse_bounces("1..3")), "1..3");
  EXPECT_EQ(to_string(parse_bounces("2")), "2..2");
}

// Red if an empty or reversed range passes, which would render black.
TEST(Parse, BouncesRefuseReversedAndZero) {
  for (const char* text : {"", "..", "1..", "..3", "3..1", "0..2", "0", "1...3", "1..x", "1..999"}) {
    EXPECT_THROW(parse_bounces(text), UsageError) << text;
  }
}

// Red if the value is cut at a second '=' or '.' (real numbers hold a dot).
TEST(Parse, KnobSettingKeepsDotsOfItsValue) {
  const KnobSetting setting = parse_knob_setting("a.b=0.5");
  EXPECT_EQ(setting.method, "a");
  EXPECT_EQ(setting.knob, "b");
  EXPECT_EQ(setting.value, "0.5");
}

// Red if an incomplete setting is taken for one with empty parts.
TEST(Parse, KnobSettingRefusesMissingParts) {
  for (const char* text : {"", "a", "a.b", "a.b=", ".b=1", "a.=1", "a=1.5"}) {
    EXPECT_THROW(parse_knob_setting(text), UsageError) << text;
  }
}

// Red if a method could be run twice under one name, whose images would overwrite each other.
TEST(Parse, NameListRefusesRepetitionAndEmptyNames) {
  EXPECT_EQ(parse_name_list("--methods", "a,b"), (std::vector<std::string>{"a", "b"}));
  for (const char* text : {"", "a,", ",a", "a,,b", "a,b,a"}) {
    EXPECT_THROW(parse_name_list("--methods", text), UsageError) << text;
  }
}

// Red if a stored command breaks on a folder with a space or a quote.
TEST(Parse, ShellQuotingSurvivesSpacesAndQuotes) {
  EXPECT_EQ(shell_quoted("cornell:boxes=2"), "cornell:boxes=2");
  EXPECT_EQ(shell_quoted("my scene"), "'my scene'");
  EXPECT_EQ(shell_quoted("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_quoted(""), "''");
}

// Red if columns are not as wide as their widest cell.
TEST(TextTable, ColumnsLineUp) {
  TextTable table({"a", "bb"});
  table.add_row({"long", "1"});
  EXPECT_EQ(table.to_string(1), "a     bb\nlong   1\n");
}

}  // namespace
}  // namespace relight
