// Pictures don't depend on the unit of length or the place of the origin.
#include "tests/reference/render.h"
#include "tests/support/image_difference.h"

namespace relight::tiny {
namespace {

using test::relative_difference;

struct Placed {
  Image direct, indirect;
};

// The room with its lights, scaled about its centre and moved; intensities scale with area so that radiance
// stays.
Placed render_placed(float scale, const glm::vec3& centre) {
  const Rendering render(room(2.0f * scale, centre, true), 24, 18);
  const float power = scale * scale;
  const LightingState lights = lighting(
      {omni(centre + scale * glm::vec3(0.3f, 0.6f, 0.4f), glm::vec3(power)),
       spot(centre + scale * glm::vec3(-0.4f, 0.9f, 0.3f), {0.3f, -1.0f, 0.1f}, 15, 25, glm::vec3(power))});
  const PathTracerResult result =
      render(lights, settings(Estimator::light_vertex, 64, 2, bounces(1, 2, true)));
  EXPECT_EQ(result.non_finite, 0);
  return {result.direct, result.indirect};
}

// Scales of 1e-3 to 1e3 are a hard case (reference/hard_cases). Powers of two change no bit of a mantissa.
TEST(Invariance, APowerOfTwoChangesNothing) {
  const Placed original = render_placed(1.0f, glm::vec3(0.0f)),
               scaled = render_placed(1024.0f, glm::vec3(0.0f));
  EXPECT_LT(relative_difference(scaled.indirect, original.indirect), 1e-3);
}

// One diagonal away nothing but rounding changes.
TEST(Invariance, MovingTheSceneOneDiagonalChangesNothingButRounding) {
  const Placed original = render_placed(1.0f, glm::vec3(0.0f));
  const Placed moved = render_placed(1.0f, glm::vec3(2.4f, -1.7f, 1.9f));
  EXPECT_LT(relative_difference(moved.direct, original.direct), 2e-3);
  EXPECT_LT(relative_difference(moved.indirect, original.indirect), 0.02);
}

// A hundred diagonals away floats resolve 1e-5 of the room. Red if (tried): the ray offset grows with the
// diagonal, not with the coordinates (surfaces would shadow themselves and the picture darken by more than
// these bounds).
TEST(Invariance, MovingTheSceneAHundredDiagonalsStaysWithinItsBound) {
  const Placed original = render_placed(1.0f, glm::vec3(0.0f));
  const Placed moved = render_placed(1.0f, glm::vec3(346.0f, -200.0f, 290.0f));
  EXPECT_LT(relative_difference(moved.direct, original.direct), 0.02);
  EXPECT_LT(relative_difference(moved.indirect, original.indirect), 0.05);
  EXPECT_NEAR(mean_of(moved.direct).x / mean_of(original.direct).x, 1.0, 0.003);
  EXPECT_NEAR(mean_of(moved.indirect).x / mean_of(original.indirect).x, 1.0, 0.005);
}

// Ten thousand diagonals away a float resolves 1/2000 of the room, and rays start a twenty-fifth of it off
// their surface: no picture to trust, so the scene is reported (validation_test), but nothing breaks. Red if
// (tried): rays hit their own surface, which would turn whole walls black.
TEST(Invariance, TenThousandDiagonalsAwayThePictureIsBlurredButThere) {
  const Placed original = render_placed(1.0f, glm::vec3(0.0f));
  const Placed moved = render_placed(1.0f, glm::vec3(20000.0f, -20000.0f, 20000.0f));
  EXPECT_NEAR(mean_of(moved.direct).x / mean_of(original.direct).x, 1.0, 0.15);
  EXPECT_NEAR(mean_of(moved.indirect).x / mean_of(original.indirect).x, 1.0, 0.15);
}

}  // namespace
}  // namespace relight::tiny
