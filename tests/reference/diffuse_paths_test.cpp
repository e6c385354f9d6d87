// Paths along diffuse vertices only take shortcuts: connections eight at once, no glossy lobes carried along.
#include "tests/reference/render.h"

namespace relight::tiny {
namespace {

// A glossy lobe too dark to change any float sends the same paths, with the same random numbers, through the
// code for all lobes. The view leaves tiles at its edges incomplete.
//
// Red if: a shortcut differs in anything but rounding from what it cuts short. Tried: the geometric normal
// left out of the test of vectorised connections (seen in the number of rays only), the number of connections
// left out of their weight, the throughput left out of the connection of a path's vertex, throughput not
// advanced through diffuse vertices.
TEST(DiffusePaths, GiveThePicturesThatTheCodeForAllLobesGives) {
  Scene scene = room();
  add_sphere(scene, {0.2f, -0.6f, 0.0f}, 0.35f, 8);  // its shading normals differ from the geometric ones
  finish_scene(scene);
  for (Material& material : scene.materials) material.glossy = glm::vec3(1e-30f), material.exponent = 5.0f;
  const Rendering render(std::move(scene), 13, 11);
  const LightingState lights =
      lighting({omni({0.3f, 0.6f, 0.4f}), spot({0.2f, 0.9f, 0.3f}, {0.3f, -1.0f, 0.1f}, 20.0f, 35.0f)});
  for (const Estimator estimator : {Estimator::light_vertex, Estimator::next_event}) {
    const PathTracerResult all = render(lights, settings(estimator, 16, 2, bounces(1, 4, true)));
    const PathTracerResult diffuse = render(lights, settings(estimator, 16, 2, bounces(1, 4, false)));
    EXPECT_EQ(all.rays, diffuse.rays);
    EXPECT_GT(mean_of(diffuse.indirect).x, 1e-3);
    for (size_t i = 0; i < all.indirect.pixels.size(); ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(all.indirect.pixels[i][c], diffuse.indirect.pixels[i][c],
                    1e-5f * all.indirect.pixels[i][c])
            << "estimator " << static_cast<int>(estimator) << ", pixel " << i;
  }
}

}  // namespace
}  // namespace relight::tiny
