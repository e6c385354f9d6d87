// Patterns of light paths: what they select, and what they refuse.
#include "reference/path_pattern.h"

#include <set>

#include "reference/direct_image.h"
#include "tests/run/error_message.h"

namespace relight {
namespace {

// Everything that can be told apart, with exact bounce counts up to 3 and "4 or more".
std::vector<PathClass> all_classes(int most_bounces = 3, int max_bounces = 30) {
  LightPaths paths;
  paths.min_bounces = 0, paths.max_bounces = max_bounces;
  paths.glossy_at_eye = paths.glossy_interior = true;
  std::vector<PathClass> classes = DirectImage::classes();
  const PathClasses sampled(most_bounces, paths, true, true, true);
  classes.insert(classes.end(), sampled.classes().begin(), sampled.classes().end());
  return classes;
}

// Names of the selected classes, sorted.
std::set<std::string> names(const std::string& pattern,
                            const std::vector<PathClass>& classes = all_classes()) {
  std::set<std::string> names;
  for (const size_t i : select_paths(pattern, classes)) names.insert(classes[i].name());
  return names;
}

using Names = std::set<std::string>;

// Red if (each tried): D and G are swapped, the eye's lobe is taken for an interior one, or an end is
// misread.
TEST(PathPattern, SelectsTheClassesThatItDescribes) {
  EXPECT_EQ(names("E L"), (Names{"seen.area", "seen.environment"}));
  EXPECT_EQ(names("E Le"), Names{"seen.environment"});
  EXPECT_EQ(names("E D L"), (Names{"b0.D.local", "b0.D.area", "b0.D.environment"}));
  EXPECT_EQ(names("E D D L"), (Names{"b1.D.D.local", "b1.D.D.area", "b1.D.D.environment"}));
  EXPECT_EQ(names("E D G Lp"), Names{"b1.D.some_G.local"});
  EXPECT_EQ(names("E G D Lp"), Names{"b1.G.D.local"});
  EXPECT_EQ(names("E D{2,3} La"), (Names{"b1.D.D.area", "b2.D.D.area"}));
  EXPECT_EQ(names("E D{4,} La"), (Names{"b3.D.D.area", "b4+.D.D.area"}));
  EXPECT_EQ(names("E D+ Le"), (Names{"b0.D.environment", "b1.D.D.environment", "b2.D.D.environment",
                                     "b3.D.D.environment", "b4+.D.D.environment"}));
  EXPECT_EQ(names("E G .* La"),
            (Names{"b0.G.area", "b1.G.D.area", "b1.G.some_G.area", "b2.G.D.area", "b2.G.some_G.area",
                   "b3.G.D.area", "b3.G.some_G.area", "b4+.G.D.area", "b4+.G.some_G.area"}));
  EXPECT_EQ(names("E . .* L").size(), all_classes().size() - 2) << "all but what the camera sees itself";
  EXPECT_EQ(names("E (D|G)* L").size(), all_classes().size());
}

// Red if (both tried): an optional or counted repetition is off by one, or S is not G.
TEST(PathPattern, ReadsWaysOfWritingTheSame) {
  const auto same = [](const std::string& a, const std::string& b) { EXPECT_EQ(names(a), names(b)) << a; };
  same("EDDL", " E  D D\tL ");
  same("E S D L", "E G D L");
  same("E . D L", "E (D|G) D L");
  same("E D? D L", "E D{1,2} L");
  same("E D{0} D L", "E D L");
  same("E D D* L", "E D+ L");
  same("E D{2,} L", "E D D+ L");
  same("E (D D){2} L", "E D{4} L");
  same("E (D|D D) D L", "E D{2,3} L");
  same("E (D*)* L", "E D* L");
  same("E ()* D L", "E D L");
  same("E (D|) D L", "E D? D L");
}

// What is longer than the counted bounces is one class, and must be taken or left as a whole. Red if (tried):
// only the next few lengths are looked at.
TEST(PathPattern, DecidesOpenClassesForAllLengths) {
  EXPECT_EQ(names("E D{0,4} L").count("b4+.D.D.area"), 0u);
  EXPECT_EQ(names("E (D D D|D D D D D)* D* L"), names("E D* L"));
  EXPECT_EQ(names("E D (D D)* Lp", all_classes(0, 1)), Names{"b0.D.local"})
      << "nothing is longer than 1 bounce";
  for (const char* pattern : {"E D{20} L", "E D{1,8} L", "E D{1,40} L", "E (D D)* L", "E (D{9})+ L",
                              "E D D* D{7} L", "E D .* G L", "E .* D L", "E D (D|G D)* L"}) {
    const std::string message = error_message([&] { names(pattern); });
    EXPECT_NE(message.find(pattern), std::string::npos) << message;
    EXPECT_NE(message.find("takes some paths of class b"), std::string::npos) << message;
  }
}

// Red if (both tried): a class that is cut is taken or left without a word.
TEST(PathPattern, RefusesToCutAClass) {
  for (const char* pattern : {"E D D G L", "E D G D L", "E D .* G L", "E D G G L"}) {
    const std::string message = error_message([&] { names(pattern, all_classes(3, 3)); });
    EXPECT_NE(message.find(pattern), std::string::npos) << message;
    EXPECT_NE(message.find("b2.D.some_G."), std::string::npos) << message;
  }
  EXPECT_EQ(names("E D (D G|G D|G G) Lp", all_classes(3, 3)), Names{"b2.D.some_G.local"}) << "not cut";
}

// Red if (both tried): the caret stands a column beside the character, or the pattern isn't repeated.
TEST(PathPattern, PointsAtTheCharacterThatIsWrong) {
  const auto expect_caret = [](const std::string& pattern, size_t column, const char* why) {
    const std::string message = error_message([&] { names(pattern); });
    EXPECT_NE(message.find(why), std::string::npos) << message;
    EXPECT_NE(message.find("\n  " + pattern + "\n  " + std::string(column, ' ') + "^"), std::string::npos)
        << message;
    EXPECT_EQ(message.back(), '^');
  };
  expect_caret("", 0, "starts at the eye");
  expect_caret("D L", 0, "starts at the eye");
  expect_caret("E D", 3, "the light");
  expect_caret("E D X L", 4, "expected a vertex");
  expect_caret("E D Lq", 5, "nothing may follow");
  expect_caret("E D L D", 6, "nothing may follow");
  expect_caret("E (D|G L", 7, "expected | or )");
  expect_caret("E D) L", 3, "expected a vertex");
  expect_caret("E D{} L", 4, "expected a number");
  expect_caret("E D{x} L", 4, "expected a number");
  expect_caret("E D{2 L", 6, "expected }");
  expect_caret("E D{3,2} L", 7, "larger number");
  expect_caret("E D{1001} L", 8, "1000");
  expect_caret("E * L", 2, "expected a vertex");
}

// Red if (tried): repetitions of repetitions fill the memory.
TEST(PathPattern, RefusesPatternsThatAreTooLarge) {
  for (const char* pattern : {"E ((D{1000}){1000}){1000} L", "E .* G .{40} L"}) {
    const std::string message = error_message([&] { names(pattern); });
    EXPECT_NE(message.find(pattern), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace relight
