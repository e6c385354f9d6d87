// relight scene export --format mitsuba: what is written says what the scene says.
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "common/image/exr.h"
#include "common/scene/scene_file.h"
#include "experiments/mitsuba/emitters.h"
#include "program.h"
#include "tests/support/xml_tree.h"

namespace relight::test {
namespace {

glm::vec3 vector_of(const std::string& text) {
  std::istringstream in(text);
  glm::vec3 v(0.0f);
  char comma = ',';
  in >> v.x >> comma >> v.y >> comma >> v.z;
  EXPECT_TRUE(in && in.eof()) << text;
  return v;
}

float number(const XmlElement& element, const std::string& name) {
  return std::stof(element.named(name).at("value"));
}

// A box with a shining ceiling lamp's worth of everything: texture, gloss, emission, sky, three lights.
constexpr const char* everything = R"(
base = "cornell:boxes=1"
exposure = 0.7
[[mesh]]
file = "quad.obj"
[[material]]
name = "red"
diffuse = [0.3, 0.1, 0.1]
glossy = 0.25
exponent = 40
[[material]]
name = "green"
emission = [1, 2, 3]
[camera]
eye = [0.1, 1, 3.5]
target = [0, 1, 0]
up = [0, 1, 0]
fov_y_degrees = 41.5
[environment]
radiance = [0.5, 0.25, 0.125]
[[lighting.all]]
type = "spot"
name = "a <lamp> & \"more\" -- here"
position = [0, 1.9, 0.3]
intensity = [80, 74, 64]
target = [0, 0, 0]
inner_degrees = 18
outer_degrees = 20
[[lighting.all]]
type = "omni"
position = [0.25, 1.5, 0.1]
intensity = [1.3, 1.2, 1.1]
casts_shadows = false
)";
constexpr const char* quad =
    "mtllib quad.mtl\nusemtl cloth\nv -9 0 -5\nv 9 0 -5\nv 9 2 -5\nv -9 2 -5\n"
    "vt 0 0\nvt 3 0\nvt 3 2\nvt 0 2\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

struct Exported {
  TemporaryFolder folder;
  Scene scene;
  ProgramResult result;
  XmlElement xml;
  explicit Exported(const std::string& arguments = "--lights all --view 64x48 --max-bounces 3") {
    write_text(folder / "everything.toml", everything);
    write_text(folder / "quad.obj", quad);
    write_text(folder / "quad.mtl", "newmtl cloth\nKd 0.5 0.5 0.5\nmap_Kd cloth.exr\n");
    Image cloth(2, 2);
    cloth.pixels = {{0.1f, 0.2f, 0.3f}, {0.4f, 0.5f, 0.6f}, {0.7f, 0.8f, 0.9f}, {0.2f, 0.4f, 0.8f}};
    write_exr(folder / "cloth.exr", cloth);
    scene = load_scene(folder / "everything.toml");
    result = run(arguments, "out");
    if (result.exit_code == 0) xml = parse_xml(read_text(folder / "out/scene.xml"));
  }
  ProgramResult run(const std::string& arguments, const std::string& out) const {
    return run_program("scene export " + folder / "everything.toml" + " --format mitsuba " + arguments +
                       " --out " + folder / out);
  }
};

// Red if: a file is named that isn't written, a material that isn't there, or a name breaks the XML.
TEST(MitsubaExport, EveryFileAndMaterialThatTheSceneNamesExists) {
  const Exported e;
  ASSERT_EQ(e.result.exit_code, 0) << e.result.err;
  EXPECT_EQ(e.xml.tag, "scene");
  std::set<std::string> bsdfs;
  for (const XmlElement* bsdf : e.xml.all("bsdf")) bsdfs.insert(bsdf->at("id"));
  EXPECT_EQ(bsdfs.size(), e.scene.materials.size());
  int files = 0;
  const std::function<void(const XmlElement&)> visit = [&](const XmlElement& element) {
    if (element.tag == "ref") {
      EXPECT_TRUE(bsdfs.contains(element.at("id"))) << element.at("id");
    }
    if (element.attributes.contains("name") && element.at("name") == "filename") {
      EXPECT_TRUE(std::filesystem::is_regular_file(e.folder / ("out/" + element.at("value"))))
          << element.at("value");
      ++files;
    }
    for (const XmlElement& child : element.children) visit(child);
  };
  visit(e.xml);
  EXPECT_GT(files, 8);
  EXPECT_TRUE(std::filesystem::is_regular_file(e.folder / "out/render.py"));
  EXPECT_NE(e.result.out.find("casts_shadows"), std::string::npos) << "a warning: " << e.result.out;
}

// Red if: triangles are lost or doubled, vertices mixed up, or the back of an emitter is not where it should
// be.
TEST(MitsubaExport, MeshesReadBackWithTheSameTrianglesAndBounds) {
  const Exported e;
  ASSERT_EQ(e.result.exit_code, 0) << e.result.err;
  size_t triangles = 0;
  double area = 0.0, expected_area = 0.0;
  Bounds bounds;
  int backs = 0;
  for (const XmlElement* shape : e.xml.all("shape")) {
    const std::string file = shape->named("filename").at("value");
    const Scene mesh = load_scene(e.folder / ("out/" + file));
    EXPECT_TRUE(mesh.repairs.counts.empty()) << file;
    if (file.find(".reverse.") != std::string::npos) {
      ++backs;
      continue;
    }
    triangles += mesh.triangles.size();
    bounds.add(mesh.bounds.lo), bounds.add(mesh.bounds.hi);
    for (size_t t = 0; t < mesh.triangles.size(); ++t) area += glm::length(mesh.area_normal(t));
  }
  for (size_t t = 0; t < e.scene.triangles.size(); ++t) expected_area += glm::length(e.scene.area_normal(t));
  EXPECT_EQ(triangles, e.scene.triangles.size());
  EXPECT_EQ(bounds.lo, e.scene.bounds.lo);
  EXPECT_EQ(bounds.hi, e.scene.bounds.hi);
  EXPECT_NEAR(area, expected_area, 1e-6 * expected_area);
  EXPECT_EQ(backs, 1);
}

// Red if: the field of view is across the wrong side, a number is rounded, or the depth is off by one.
TEST(MitsubaExport, CameraAndIntegratorRoundTrip) {
  const Exported e;
  ASSERT_EQ(e.result.exit_code, 0) << e.result.err;
  const XmlElement& sensor = *e.xml.all("sensor").at(0);
  EXPECT_EQ(sensor.named("fov_axis").at("value"), "y");
  EXPECT_EQ(number(sensor, "fov"), e.scene.camera.fov_y_degrees);
  const XmlElement& look = *sensor.named("to_world").all("lookat").at(0);
  EXPECT_EQ(vector_of(look.at("origin")), e.scene.camera.eye);
  EXPECT_EQ(vector_of(look.at("target")), e.scene.camera.target);
  EXPECT_EQ(vector_of(look.at("up")), e.scene.camera.up);
  EXPECT_LT(number(sensor, "near_clip"), 1e-4f);
  EXPECT_GT(number(sensor, "far_clip"), 10.0f);
  const XmlElement& film = *sensor.all("film").at(0);
  EXPECT_EQ(number(film, "width"), 64);
  EXPECT_EQ(number(film, "height"), 48);
  // 3 bounces of indirect light: eye, 4 surfaces, light: 5 segments.
  EXPECT_EQ(number(*e.xml.all("integrator").at(0), "max_depth"), 5);
}

// Red if: a light is lost, its numbers are rounded, or the sky or the emission is.
TEST(MitsubaExport, LightsRoundTrip) {
  const Exported e;
  ASSERT_EQ(e.result.exit_code, 0) << e.result.err;
  const LightingState& lighting = e.scene.lightings.at("all");
  const auto emitters = e.xml.all("emitter");
  ASSERT_EQ(emitters.size(), 3u);
  EXPECT_EQ(emitters[0]->at("type"), "spot");
  const Light& spot = lighting.lights[0];
  const XmlElement& look = *emitters[0]->named("to_world").all("lookat").at(0);
  EXPECT_EQ(vector_of(look.at("origin")), spot.position);
  const glm::vec3 axis = glm::normalize(vector_of(look.at("target")) - spot.position);
  EXPECT_NEAR(glm::dot(axis, spot.direction), 1.0f, 1e-6f);
  EXPECT_LT(std::abs(glm::dot(axis, vector_of(look.at("up")))), 0.99f) << "no frame from a parallel up";
  EXPECT_EQ(vector_of(emitters[0]->named("intensity").at("value")), spot.intensity);
  EXPECT_EQ(number(*emitters[0], "cutoff_angle"), spot.outer_degrees);
  EXPECT_EQ(emitters[1]->at("type"), "point");
  const XmlElement& position = emitters[1]->named("position");
  EXPECT_EQ(glm::vec3(std::stof(position.at("x")), std::stof(position.at("y")), std::stof(position.at("z"))),
            lighting.lights[1].position);
  EXPECT_EQ(vector_of(emitters[1]->named("intensity").at("value")), lighting.lights[1].intensity);
  EXPECT_EQ(emitters[2]->at("type"), "constant");
  EXPECT_EQ(vector_of(emitters[2]->named("radiance").at("value")), e.scene.environment.radiance);
  int shining = 0;
  for (const XmlElement* shape : e.xml.all("shape"))
    for (const XmlElement* emitter : shape->all("emitter")) {
      EXPECT_EQ(vector_of(emitter->named("radiance").at("value")), glm::vec3(1, 2, 3));
      ++shining;
    }
  EXPECT_EQ(shining, 2) << "front and back";
}

// Red if: a model gets the other's name, a colour is lost, or a texture is encoded, flipped or not
// multiplied.
TEST(MitsubaExport, MaterialsRoundTrip) {
  const Exported e;
  ASSERT_EQ(e.result.exit_code, 0) << e.result.err;
  const auto bsdfs = e.xml.all("bsdf");
  int textured = 0, glossy = 0;
  for (size_t i = 0; i < bsdfs.size(); ++i) {
    const Material& material = e.scene.materials[i];
    const bool phong = bsdfs[i]->at("type") == "relight_phong";
    EXPECT_EQ(phong, material.is_glossy());
    if (phong) {
      EXPECT_EQ(vector_of(bsdfs[i]->named("glossy").at("value")), material.glossy);
      EXPECT_EQ(number(*bsdfs[i], "exponent"), material.exponent);
      ++glossy;
    } else {
      EXPECT_EQ(bsdfs[i]->at("type"), "twosided");
    }
    const XmlElement& albedo =
        phong ? bsdfs[i]->named("diffuse") : bsdfs[i]->all("bsdf").at(0)->named("reflectance");
    if (material.diffuse_texture < 0) {
      EXPECT_EQ(vector_of(albedo.at("value")), material.diffuse);
      continue;
    }
    ++textured;
    EXPECT_EQ(albedo.named("raw").at("value"), "true");
    const Image image = read_exr(e.folder / ("out/" + albedo.named("filename").at("value")));
    const Texture& texture = e.scene.textures[static_cast<size_t>(material.diffuse_texture)];
    ASSERT_EQ(image.pixels.size(), texture.texels.size());
    for (size_t p = 0; p < image.pixels.size(); ++p)
      EXPECT_EQ(image.pixels[p], material.diffuse * texture.texels[p]);
  }
  EXPECT_EQ(textured, 1);
  EXPECT_EQ(glossy, 1);
}

// Red if: the falloff's picture is scaled to the wrong cone, or off by a texel.
TEST(MitsubaExport, TheSpotsPictureHoldsItsFalloff) {
  Light spot;
  spot.type = LightType::spot;
  spot.inner_degrees = 30.0f, spot.outer_degrees = 40.0f;
  const Image image = mitsuba::spot_falloff(spot);
  const double texels = image.width, edge = std::tan(glm::radians(40.0));
  for (double degrees : {0.5, 29.5, 33.0, 37.0, 39.9, 41.0}) {
    const double c = std::cos(glm::radians(degrees)), inner = std::cos(glm::radians(30.0)),
                 outer = std::cos(glm::radians(40.0));
    const double t = std::clamp((c - outer) / (inner - outer), 0.0, 1.0);
    // As a projector looks it up, to the nearest texel along its middle row.
    const double u = 0.5 + 0.5 * std::tan(glm::radians(degrees)) / edge;
    const int x = std::min(static_cast<int>(u * texels), image.width - 1);
    EXPECT_NEAR(image.at(x, image.height / 2).x, t * t * (3.0 - 2.0 * t), 0.01) << degrees;
  }
}

// Red if: the output depends on anything but the input, or a temporary file is left.
TEST(MitsubaExport, TheSameInputGivesTheSameBytes) {
  const Exported e;
  ASSERT_EQ(e.run("--lights all --view 64x48 --max-bounces 3", "again").exit_code, 0);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(e.folder / "out")) {
    if (!entry.is_regular_file()) continue;
    const auto relative = std::filesystem::relative(entry.path(), e.folder / "out");
    EXPECT_TRUE(read_text(entry.path()) == read_text(e.folder / "again" / relative)) << relative;
    EXPECT_EQ(entry.path().filename().string().find(".tmp"), std::string::npos) << relative;
  }
}

}  // namespace
}  // namespace relight::test
