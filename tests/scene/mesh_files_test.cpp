// What good files mean: colours, roughness, texture orientation, node transforms, computed normals.
#include <cmath>

#include "common/scene/files/material_conversion.h"
#include "common/scene/scene_file.h"
#include "common/scene/topology.h"
#include "tests/scene/corpus.h"

namespace relight {
namespace {

// Colours of four_colours.png: red and green below, blue and grey (128) above.
void expect_four_colours(const Texture& texture) {
  ASSERT_EQ(texture.width, 2);
  ASSERT_EQ(texture.height, 2);
  EXPECT_EQ(texture.sample({0.25f, 0.25f}), glm::vec3(1, 0, 0));
  EXPECT_EQ(texture.sample({0.75f, 0.25f}), glm::vec3(0, 1, 0));
  EXPECT_EQ(texture.sample({0.25f, 0.75f}), glm::vec3(0, 0, 1));
  // sRGB 128/255 is 0.21586 in linear light (IEC 61966-2-1).
  EXPECT_NEAR(texture.sample({0.75f, 0.75f}).y, 0.21586f, 1e-4f);
}

// Red if the picture is upside down, or taken as linear, or Kd is not multiplied.
TEST(ObjFiles, MultiplyKdWithASrgbTextureWhoseFirstRowIsOnTop) {
  const Scene scene = load_scene(testing_corpus::path("textured.obj"));
  const Material& material = scene.materials[scene.triangles[0].material];
  ASSERT_EQ(scene.textures.size(), 1u);
  ASSERT_EQ(material.diffuse_texture, 0);
  EXPECT_EQ(material.diffuse, glm::vec3(0.5f, 0.5f, 1.0f));
  expect_four_colours(scene.textures[0]);
  EXPECT_EQ(scene.uvs[scene.triangles[0].v[2]], glm::vec2(0, 1));
}

// Red if a parent's transform is lost, glTF's v axis is not turned, or the embedded picture is not found.
TEST(GlbFiles, ApplyNodeTransformsAndReadEmbeddedTextures) {
  const Scene scene = load_scene(testing_corpus::path("textured.glb"));
  ASSERT_EQ(scene.triangles.size(), 1u);
  EXPECT_EQ(scene.bounds.lo, glm::vec3(10, 0, 0));
  EXPECT_EQ(scene.bounds.hi, glm::vec3(12, 2, 0));
  const Material& material = scene.materials[scene.triangles[0].material];
  ASSERT_EQ(material.diffuse_texture, 0);
  expect_four_colours(scene.textures[0]);
  // The file's v = 1 is at the bottom of the picture; here v = 0 is.
  for (uint32_t v : scene.triangles[0].v) EXPECT_NEAR(scene.uvs[v].y, scene.positions[v].y / 2.0f, 1e-6f);
  EXPECT_EQ(material.glossy, glm::vec3(0.04f));
  EXPECT_EQ(material.glossy_part().model(), BrdfModel::ggx);
  EXPECT_NEAR(material.exponent, 0.25f, 1e-6f);  // the file's roughness is 0.5
  EXPECT_NEAR(material.diffuse.x, 0.96f, 1e-6f);
}

// Red if Pr is taken for the GGX alpha itself, or Pm is ignored: the kitchen's hood has alpha 0.08, exponent
// 310.5.
TEST(MaterialConversion, TurnsRoughnessAndMetallicIntoTheGlossyLobe) {
  EXPECT_NEAR(phong_exponent_from_roughness(std::sqrt(0.08f)), 310.5f, 0.01f);
  EXPECT_EQ(phong_exponent_from_roughness(0.0f), 1e5f);
  EXPECT_EQ(phong_exponent_from_roughness(1.0f), 0.0f);
  FileMaterial conductor;
  conductor.base = glm::vec3(0.3f);
  conductor.specular = {0.7f, 0.6f, 0.5f};
  conductor.metallic = 1.0f;
  conductor.roughness = 0.3f;
  EXPECT_EQ(convert_material(conductor).diffuse, glm::vec3(0.0f));
  EXPECT_EQ(convert_material(conductor).glossy, conductor.specular);
  FileMaterial matt;
  matt.base = glm::vec3(0.0f);
  matt.has_texture = true;
  EXPECT_EQ(convert_material(matt).diffuse, glm::vec3(1.0f));
  EXPECT_FALSE(convert_material(matt).is_glossy());
}

// Red if the scale-down changes the hue, or lets a coated white surface reflect 1.04.
TEST(MaterialRepair, LimitsDiffusePlusGlossyToOneAndKeepsTheHue) {
  const Scene scene = load_scene(testing_corpus::path("wrong_materials.obj"));
  const auto material = [&](const char* name) {
    for (const Material& m : scene.materials)
      if (m.name == name) return m;
    ADD_FAILURE() << name;
    return Material();
  };
  EXPECT_EQ(material("bright").diffuse, glm::vec3(1.0f, 0.5f, 0.25f));
  EXPECT_EQ(material("negative").diffuse, glm::vec3(0.5f, 0.0f, 0.5f));
  EXPECT_NEAR(material("coated").diffuse.x, 0.96f, 1e-6f);
  EXPECT_NEAR(material("coated").exponent, 198.0f, 1.0f);
}

// Red if edges of a cube are smoothed, or its normals point inwards.
TEST(ComputedNormals, KeepTheEdgesOfACubeSharp) {
  const Scene scene = load_scene(testing_corpus::path("cube_without_normals.obj"));
  EXPECT_EQ(scene.positions.size(), 24u);
  for (size_t v = 0; v < scene.positions.size(); ++v) {
    const glm::vec3 outward = scene.positions[v] - glm::vec3(0.5f);
    EXPECT_EQ(glm::max(glm::abs(scene.normals[v].x),
                       glm::max(glm::abs(scene.normals[v].y), glm::abs(scene.normals[v].z))),
              1.0f);
    EXPECT_GT(glm::dot(scene.normals[v], outward), 0.0f);
  }
  EXPECT_TRUE(examine_edges(weld_positions(scene.positions), scene.triangles).closed());
  EXPECT_NEAR(signed_volume(scene.positions, scene.triangles), 1.0, 1e-6);
}

// Red if one field of a scene file is read into another, in the wrong unit, or not at all.
TEST(SceneFiles, SetEveryFieldTheyName) {
  const Scene scene = load_scene(testing_corpus::path("complete.toml"));
  EXPECT_EQ(scene.triangles.size(), 10u + 12u);
  EXPECT_EQ(scene.exposure, 2.5f);
  EXPECT_EQ(scene.camera.eye, glm::vec3(0, 1, 3));
  EXPECT_EQ(scene.camera.fov_y_degrees, 50.0f);
  ASSERT_EQ(scene.views.count("side"), 1u);
  EXPECT_EQ(scene.views.at("side").eye, glm::vec3(3, 1, 0));
  EXPECT_EQ(scene.views.at("side").target, scene.camera.target) << "left out: as the camera's";
  EXPECT_EQ(scene.views.at("side").fov_y_degrees, 30.0f);
  const Triangle& last = scene.triangles.back();
  EXPECT_TRUE(scene.object_names[last.object].starts_with("block: "));
  const Material& material = scene.materials[last.material];
  EXPECT_EQ(material.diffuse, glm::vec3(0.2f, 0.4f, 0.6f));
  EXPECT_EQ(material.glossy, glm::vec3(0.1f));
  EXPECT_EQ(material.exponent, 30.0f);
  EXPECT_EQ(material.emission, glm::vec3(0, 0, 1));
  EXPECT_EQ(material.diffuse_texture, 0);
  // The unit cube, halved in x and z, turned by 90 degrees about y ((x, z) -> (z, -x)), moved.
  Bounds block;
  for (const Triangle& t : scene.triangles)
    if (t.object == last.object)
      for (uint32_t v : t.v) block.add(scene.positions[v]);
  EXPECT_NEAR(glm::length(block.lo - glm::vec3(0.1f, 0.0f, -0.3f)), 0.0f, 1e-6f);
  EXPECT_NEAR(glm::length(block.hi - glm::vec3(0.6f, 1.0f, 0.2f)), 0.0f, 1e-6f);
  EXPECT_EQ(scene.environment.radiance, glm::vec3(0.5f, 0.5f, 1.0f));
  EXPECT_NEAR(scene.environment.rotation_y, 1.5707963f, 1e-6f);
  EXPECT_EQ(scene.environment.texels[0], glm::vec3(0, 0, 1));
  const LightingState lamps = load_lighting(scene, "lamps");
  ASSERT_EQ(lamps.lights.size(), 2u);
  EXPECT_EQ(lamps.lights[0].name, "desk lamp");
  EXPECT_EQ(lamps.lights[0].direction, glm::vec3(0, -1, 0));
  EXPECT_EQ(lamps.lights[0].intensity, glm::vec3(3, 2, 1));
  EXPECT_EQ(lamps.lights[0].outer_degrees, 15.0f);
  EXPECT_FALSE(lamps.lights[0].casts_shadows);
  EXPECT_EQ(lamps.lights[1].type, LightType::omni);
  EXPECT_EQ(lamps.lights[1].intensity, glm::vec3(2));
  EXPECT_TRUE(scene.lightings.contains("near"));
}

// Red if a model's parameters land in another's fields, or a table that names no model changes it (tried:
// exponent_u and exponent_v exchanged; the model dropped when only glossy is given).
TEST(SceneFiles, ChooseTheReflectionModelOfAMaterial) {
  const Scene scene = load_scene(testing_corpus::path("models.toml"));
  const auto part = [&](const char* name) {
    for (const Material& m : scene.materials)
      if (m.name == name) return m.glossy_part();
    ADD_FAILURE() << name;
    return GlossyPart{};
  };
  EXPECT_EQ(part("white").model(), BrdfModel::ashikhmin_shirley);
  EXPECT_EQ(part("white").glossy, glm::vec3(0.1f));
  EXPECT_EQ(part("white").exponent, 10.0f);
  EXPECT_EQ(part("white").shape.exponent_v, 100.0f);
  EXPECT_EQ(part("red").model(), BrdfModel::ggx);
  EXPECT_EQ(part("red").glossy, glm::vec3(0.08f));
  EXPECT_EQ(part("red").exponent, 0.2f);
  EXPECT_EQ(part("red").shape.exponent_v, 0.4f);
  EXPECT_EQ(part("green").model(), BrdfModel::lafortune);
  EXPECT_NEAR(part("green").glossy.x, 0.3f, 1e-6f);
  EXPECT_EQ(part("green").exponent, 20.0f);
  EXPECT_EQ(part("green").shape.exponent_v, 5.0f);
  EXPECT_EQ(glm::unpackHalf2x16(part("green").shape.ratios_1), glm::vec2(0.5f));
  EXPECT_EQ(part("blue grey").model(), BrdfModel::phong);
}

// Red if the spot's axis is not normalised or the default inner angle is not below the outer.
TEST(LightingFiles, HoldOneLightATable) {
  const LightingState lighting = load_lighting(load_scene("cornell"), testing_corpus::path("lights.toml"));
  EXPECT_EQ(lighting.name, "evening");
  ASSERT_EQ(lighting.lights.size(), 2u);
  EXPECT_EQ(lighting.lights[1].direction, glm::vec3(0, -1, 0));
  EXPECT_NEAR(lighting.lights[1].inner_degrees, 24.0f, 1e-4f);
}

}  // namespace
}  // namespace relight
