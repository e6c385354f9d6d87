// What a method leaves out on purpose, where it is known exactly.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "explaining.h"

namespace relight::test {
namespace {

// A sphere of radius 1 seen from within, as quads between 64 meridians and 32 parallels.
std::string sphere_obj() {
  constexpr int meridians = 64, parallels = 32;
  std::string obj;
  for (int p = 0; p <= parallels; ++p)
    for (int m = 0; m < meridians; ++m) {
      const double polar = std::numbers::pi * p / parallels, around = 2.0 * std::numbers::pi * m / meridians;
      obj += fmt::format("v {:.9f} {:.9f} {:.9f}\n", std::sin(polar) * std::cos(around), std::cos(polar),
                         std::sin(polar) * std::sin(around));
    }
  const auto index = [](int p, int m) { return 1 + p * meridians + m % meridians; };
  for (int p = 0; p < parallels; ++p)
    for (int m = 0; m < meridians; ++m) {
      if (p > 0) obj += fmt::format("f {} {} {}\n", index(p, m), index(p + 1, m + 1), index(p, m + 1));
      if (p + 1 < parallels)
        obj += fmt::format("f {} {} {}\n", index(p, m), index(p + 1, m), index(p + 1, m + 1));
    }
  return obj;
}

// A lamp in the middle of a sphere of albedo a lights it evenly, and so does each bounce, with a times the
// light of the one before. Of direct light and one bounce the sum of all, L / (1 - a), lacks a^2; of one
// bounce alone all indirect light, a L / (1 - a), lacks a. Red if the second reference ends after a few
// bounces (tried: two, 0.143 in place of 0.25), or the share is one of the restricted picture.
TEST(ModelError, IsWhatOneBounceLacksInASphere) {
  const TemporaryFolder folder;
  constexpr double albedo = 0.5;
  write_text(folder / "sphere.obj", sphere_obj());
  write_text(
      folder / "sphere.toml",
      fmt::format("[[mesh]]\nfile = 'sphere.obj'\n[[material]]\nname = 'DefaultMaterial'\ndiffuse = {}\n"
                  "[camera]\neye = [0.3, 0.1, 0]\ntarget = [-1, 0, 0]\nup = [0, 1, 0]\n"
                  "[[lighting.lamp]]\ntype = 'omni'\nposition = [0, 0, 0]\nintensity = 0.5\n",
                  albedo));
  Explaining explaining({});
  explaining.options.session.scene = folder / "sphere.toml";
  explaining.options.session.lights = "lamp";
  explaining.options.session.view = "32x32";
  const Explanation e = explaining.run();
  EXPECT_NEAR(e.model.share[Measure::relative], albedo * albedo, 0.01);
  EXPECT_NEAR(e.model.share[Measure::indirect_linear], albedo, 0.01);
  EXPECT_LT(e.model.half_width[Measure::relative], 0.01);
  // The planted method is exact here: none of that is its error.
  EXPECT_LT(e.waterfall.asked[Measure::relative], 0.02);
  EXPECT_NE(model_sentence(e).find("more than 1 bounce"), std::string::npos);
}

}  // namespace
}  // namespace relight::test
