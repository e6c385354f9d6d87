// Light with an extent found in two ways, by points drawn from it and by the BRDF's rays, or by rays alone:
// the answers agree if and only if the weights of the two ways sum to one.
#include "common/brdf/brdf_lobes.h"
#include "tests/reference/area_shapes.h"
#include "tests/reference/render.h"
#include "tests/reference/skies.h"

namespace relight::tiny {
namespace {

enum class Surface { diffuse, sharp_ggx, sharp_phong, rough_ggx };
enum class Source {
  large_rectangle,
  small_rectangle,
  disc,
  mesh,
  touching_mesh,
  touching_rectangle,
  sky,
  sun
};

struct Case {
  const char* name;
  Surface surface;
  Source source;
  int samples;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Material material_of(Surface surface) {
  Material m;
  m.diffuse = glm::vec3(0.5f);
  if (surface == Surface::sharp_ggx) m.set_glossy_part(ggx_part(glm::vec3(0.4f), 0.01f, 0.01f));
  if (surface == Surface::rough_ggx) m.set_glossy_part(ggx_part(glm::vec3(0.4f), 0.3f, 0.2f));
  if (surface == Surface::sharp_phong) m.set_glossy_part(phong_part(glm::vec3(0.4f), 1000.0f));
  return m;
}

// Sources that a mirror shows to the camera, so that the sharp lobes see some of their light.
const check::Rectangle large{{-0.7, 0.75, -0.6}, {1.3, 0, 0}, {0, 0, 1.1}};
const check::Rectangle small{{-0.15, 0.3, -0.25}, {0.3, 0, 0}, {0, 0, 0.3}};
const check::Rectangle wall{{-0.6, -1, -0.9}, {1.2, 0, 0}, {0, 0.7, 0}};  // stands on the floor

// The room of tiny_scenes.h with one material.
Scene scene_of(const Case& c) {
  Scene scene = room();
  for (Material& m : scene.materials) {
    const glm::vec3 diffuse = m.diffuse;
    m = material_of(c.surface);
    if (c.surface == Surface::diffuse) m.diffuse = diffuse;
  }
  const uint32_t lamp = add_material(scene, black_material(glm::vec3(2.0f)));
  if (c.source == Source::mesh) add_rectangle(scene, large, lamp);
  if (c.source == Source::touching_mesh) add_rectangle(scene, wall, lamp);
  if (c.source == Source::sky) scene.environment = uneven_map(8, 4, 0.5f);
  if (c.source == Source::sun) {
    scene.environment = black_map(16, 8);
    for (glm::vec3& t : scene.environment.texels) t = glm::vec3(0.1f);
    // Seen through the open front.
    const glm::dvec2 place = place_in_map(scene.environment, glm::normalize(glm::dvec3(0.1, 0.3, 1.0)));
    scene.environment
        .texels[static_cast<size_t>(static_cast<int>(place.y) * 16 + static_cast<int>(place.x))] =
        glm::vec3(20.0f);
  }
  finish_scene(scene);
  return scene;
}

LightingState lights_of(Source source) {
  const glm::vec3 shine(2.0f);
  if (source == Source::large_rectangle) return lighting({rectangle_light(large, shine)});
  if (source == Source::small_rectangle) return lighting({rectangle_light(small, 5.0f * shine)});
  if (source == Source::disc)
    return lighting({disc_light({0.1, 0.5, 0.2}, {0.3, -1, -0.4}, 0.25, 5.0f * shine)});
  if (source == Source::touching_rectangle) return lighting({rectangle_light(wall, shine)});
  return {};
}

class ExtendedLights : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(
    Cases, ExtendedLights,
    testing::Values(Case{"diffuse_large", Surface::diffuse, Source::large_rectangle, 64},
                    Case{"diffuse_small", Surface::diffuse, Source::small_rectangle, 512},
                    Case{"diffuse_disc", Surface::diffuse, Source::disc, 256},
                    Case{"diffuse_mesh", Surface::diffuse, Source::mesh, 64},
                    Case{"diffuse_touching_mesh", Surface::diffuse, Source::touching_mesh, 128},
                    Case{"diffuse_touching_rectangle", Surface::diffuse, Source::touching_rectangle, 128},
                    Case{"diffuse_sky", Surface::diffuse, Source::sky, 256},
                    Case{"diffuse_sun", Surface::diffuse, Source::sun, 256},
                    Case{"rough_ggx_disc", Surface::rough_ggx, Source::disc, 256},
                    Case{"rough_ggx_sky", Surface::rough_ggx, Source::sky, 256},
                    Case{"sharp_ggx_large", Surface::sharp_ggx, Source::large_rectangle, 64},
                    Case{"sharp_ggx_small", Surface::sharp_ggx, Source::small_rectangle, 512},
                    Case{"sharp_ggx_mesh", Surface::sharp_ggx, Source::mesh, 64},
                    Case{"sharp_ggx_touching", Surface::sharp_ggx, Source::touching_mesh, 128},
                    Case{"sharp_ggx_sky", Surface::sharp_ggx, Source::sky, 256},
                    Case{"sharp_ggx_sun", Surface::sharp_ggx, Source::sun, 256},
                    Case{"sharp_phong_large", Surface::sharp_phong, Source::large_rectangle, 64},
                    Case{"sharp_phong_small", Surface::sharp_phong, Source::small_rectangle, 512},
                    Case{"sharp_phong_sun", Surface::sharp_phong, Source::sun, 256}),
    [](const auto& test) { return std::string(test.param.name); });

// Mean of the picture over 16 seeds each; 6 standard errors of about 30 degrees of freedom: a false alarm in
// 7e5 for each case. Red if (both tried): a weight has the density of the
// other way in the wrong measure, or is left out. (The choice among several lights:
// AreaLights.LightOfSeveralAddsUp.)
TEST_P(ExtendedLights, GiveTheSameWithAndWithoutSampling) {
  const Case& c = GetParam();
  const Rendering render(scene_of(c), 8, 6);
  LightPaths paths = bounces(0, 1, true);
  paths.emission = paths.environment = true;
  PathTracerSettings s = settings(Estimator::next_event, c.samples, 2, paths, 1);
  const PictureMean both(render, lights_of(c.source), s, 16);
  s.seed = 2, s.samples_per_pixel *= 4, s.sample_extended_lights = false;
  const PictureMean rays(render, lights_of(c.source), s, 16);
  const double error = std::hypot(both.error, rays.error);
  EXPECT_LT(std::abs(both.mean - rays.mean), 6.0 * error) << both.mean << " against " << rays.mean;
  EXPECT_LT(6.0 * error, 0.15 * both.mean) << "too noisy to tell";
}

// The reason for either way. Red if (both tried): small lights are not sampled on diffuse surfaces, or the
// weight of the BRDF's ray is lost where a sharp lobe meets a large light.
TEST(ExtendedLightsNoise, IsLowWhereOneOfTheTwoWaysIsGood) {
  const auto noise = [](Surface surface, Source source, bool sampled) {
    const Rendering render(scene_of({"", surface, source, 0}), 16, 12);
    PathTracerSettings s = settings(Estimator::next_event, 64, 16, bounces(0, 0, true));
    s.sample_extended_lights = sampled;
    return mean_of(render(lights_of(source), s).indirect_variance).x;
  };
  EXPECT_LT(noise(Surface::diffuse, Source::small_rectangle, true),
            0.05 * noise(Surface::diffuse, Source::small_rectangle, false));
  EXPECT_LT(noise(Surface::sharp_ggx, Source::large_rectangle, true),
            1.5 * noise(Surface::sharp_ggx, Source::large_rectangle, false));
}

}  // namespace
}  // namespace relight::tiny
