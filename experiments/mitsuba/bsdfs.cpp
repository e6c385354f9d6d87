#include "experiments/mitsuba/bsdfs.h"

#include <fmt/format.h>

#include "common/run/error.h"
#include "experiments/mitsuba/texture_file.h"

namespace relight::mitsuba {

namespace {

// The material's texture times its colour, linear. Both renderers put the centre of texel (i, j) at
// ((i + 0.5) / width, (j + 0.5) / height), interpolate linearly and wrap around. Mitsuba's v = 0 is the first
// row of the file, ours the first row of texels: the rows stay in order.
Image coloured_texture(const Texture& texture, const glm::vec3& colour) {
  Image image(texture.width, texture.height);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = colour * texture.texels[i];
  return image;
}

// Lambert albedo under the parameter `name`.
void write_albedo(XmlWriter& xml, const std::string& name, const Scene& scene, size_t index,
                  const std::filesystem::path& folder) {
  const Material& material = scene.materials[index];
  if (material.diffuse_texture < 0) return xml.rgb(name, material.diffuse);
  const std::string file = fmt::format("textures/{}.exr", bsdf_id(index));
  write_texture(folder / file, coloured_texture(scene.textures[static_cast<size_t>(material.diffuse_texture)],
                                                material.diffuse));
  xml.open("texture", {{"type", "bitmap"}, {"name", name}});
  xml.value("string", "filename", file);
  xml.value("boolean", "raw", "true");  // the numbers are albedos already
  xml.value("string", "wrap_mode", "repeat");
  xml.close();
}

void write_diffuse(XmlWriter& xml, const Scene& scene, size_t index, const std::filesystem::path& folder) {
  xml.open("bsdf", {{"type", "twosided"}, {"id", bsdf_id(index)}});
  xml.open("bsdf", {{"type", "diffuse"}});
  write_albedo(xml, "reflectance", scene, index, folder);
  xml.close();
  xml.close();
}

// Mitsuba 3 has no Phong model: render.py brings one with the formula of common/brdf/phong.glsl.
void write_phong(XmlWriter& xml, const Scene& scene, size_t index, const std::filesystem::path& folder) {
  const Material& material = scene.materials[index];
  xml.open("bsdf", {{"type", "relight_phong"}, {"id", bsdf_id(index)}});
  write_albedo(xml, "diffuse", scene, index, folder);
  xml.rgb("glossy", material.glossy);
  xml.number("exponent", material.exponent);
  xml.close();
}

using Writer = void (*)(XmlWriter&, const Scene&, size_t, const std::filesystem::path&);
constexpr const char* known_models = "diffuse, phong";

// Null for a model without a writer.
Writer writer_of(const Material& material) {
  if (!material.is_glossy()) return write_diffuse;
  return material.glossy_part().model() == BrdfModel::phong ? write_phong : nullptr;
}

const char* name_of(BrdfModel model) {
  switch (model) {
    case BrdfModel::phong:
      return "phong";
    case BrdfModel::ashikhmin_shirley:
      return "ashikhmin_shirley";
    case BrdfModel::lafortune:
      return "lafortune";
    case BrdfModel::ggx:
      return "ggx";
  }
  return "unknown";
}

}  // namespace

void require_known_models(const Scene& scene) {
  for (size_t i = 0; i < scene.materials.size(); ++i)
    if (!writer_of(scene.materials[i]))
      fail("material '{}' ({}) reflects with the {} model; models that the Mitsuba export knows: {}",
           scene.materials[i].name, bsdf_id(i), name_of(scene.materials[i].glossy_part().model()),
           known_models);
}

std::string bsdf_id(size_t material) { return fmt::format("material-{}", material); }

void write_bsdf(XmlWriter& xml, const Scene& scene, size_t material, const std::filesystem::path& folder) {
  xml.comment(scene.materials[material].name);
  writer_of(scene.materials[material])(xml, scene, material, folder);
}

}  // namespace relight::mitsuba
