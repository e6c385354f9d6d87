#include "experiments/mitsuba/export.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "common/lights/light_animation.h"
#include "common/run/atomic_file.h"
#include "experiments/mitsuba/bsdfs.h"
#include "experiments/mitsuba/emitters.h"
#include "experiments/mitsuba/render_script.h"
#include "experiments/mitsuba/shapes.h"
#include "experiments/options/parse.h"
#include "experiments/session/output_folder.h"
#include "experiments/session/session.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

using mitsuba::text_of;
using mitsuba::XmlWriter;

constexpr int most_bounces = 64;  // as for `relight reference`

// k bounces are k + 2 segments from the eye to the light; Mitsuba counts segments.
void write_integrator(XmlWriter& xml, int max_bounces) {
  xml.comment(fmt::format("light after at most {} bounces of indirect light", max_bounces));
  xml.open("integrator", {{"type", "path"}});
  xml.value("integer", "max_depth", std::to_string(max_bounces + 2));
  xml.close();
}

// A box filter and square pixels, as the reference has them.
void write_film(XmlWriter& xml, const View& view) {
  xml.open("film", {{"type", "hdrfilm"}});
  xml.value("integer", "width", std::to_string(view.width));
  xml.value("integer", "height", std::to_string(view.height));
  xml.value("string", "pixel_format", "rgb");
  xml.value("string", "component_format", "float32");
  xml.leaf("rfilter", {{"type", "box"}});
  xml.close();
}

void write_sensor(XmlWriter& xml, const Scene& scene, const View& view) {
  const Camera& camera = view.camera;
  // Nothing may be cut off: the planes lie far outside of what the scene can hold.
  const float reach = scene.bounds.diagonal() + glm::length(scene.bounds.centre() - camera.eye);
  xml.open("sensor", {{"type", "perspective"}});
  xml.value("string", "fov_axis", "y");
  xml.number("fov", camera.fov_y_degrees);
  xml.number("near_clip", 1e-6f * reach);
  xml.number("far_clip", 10.0f * reach);
  xml.open("transform", {{"name", "to_world"}});
  xml.leaf("lookat",
           {{"origin", text_of(camera.eye)}, {"target", text_of(camera.target)}, {"up", text_of(camera.up)}});
  xml.close();
  xml.leaf("sampler", {{"type", "multijitter"}});
  write_film(xml, view);
  xml.close();
}

std::string summary(const Scene& scene, const std::filesystem::path& out, const mitsuba::ShapeCounts& shapes,
                    const std::vector<std::string>& warnings) {
  std::string text =
      fmt::format("{}: {} triangles in {} meshes, {} materials\n", (out / "scene.xml").string(),
                  shapes.triangles, shapes.meshes, scene.materials.size());
  if (shapes.emitter_backs > 0)
    text += fmt::format("{} emitting meshes were written twice, for their two sides\n", shapes.emitter_backs);
  for (const std::string& warning : warnings) text += "warning: " + warning + "\n";
  return text + fmt::format("render it with Mitsuba 3: python3 {} --spp 256 --out mitsuba.exr\n",
                            shell_quoted((out / "render.py").string()));
}

}  // namespace

std::string export_mitsuba(const MitsubaExportOptions& options) {
  parse_view(options.view);
  if (options.max_bounces < 0 || options.max_bounces > most_bounces)
    usage_fail("--max-bounces {}: expected 0 (direct light only) to {}", options.max_bounces, most_bounces);
  require_writable_folder("--out", options.out);
  const Scene scene = load_named_scene(options.scene);
  mitsuba::require_known_models(scene);
  const View view = choose_view(scene, options.view);
  const ChosenLighting chosen = choose_lights(scene, options.lights);
  const LightingState lighting = lighting_at(chosen.animated, chosen.time);
  const std::filesystem::path out = options.out;

  std::vector<std::string> warnings;
  XmlWriter xml;
  xml.comment(fmt::format("scene '{}', lights '{}', exported by relight", options.scene, chosen.name));
  xml.comment(
      fmt::format("lengths in scene units, radiance in W/(m^2 sr), linear RGB; for display, relight "
                  "multiplies by the exposure {}",
                  scene.exposure));
  xml.open("scene", {{"version", "3.0.0"}});
  write_integrator(xml, options.max_bounces);
  write_sensor(xml, scene, view);
  for (size_t i = 0; i < scene.materials.size(); ++i) mitsuba::write_bsdf(xml, scene, i, out);
  const mitsuba::ShapeCounts shapes = mitsuba::write_shapes(xml, scene, out);
  for (size_t i = 0; i < lighting.lights.size(); ++i)
    mitsuba::write_light(xml, lighting.lights[i], i, out, warnings);
  mitsuba::write_environment(xml, scene.environment, out);
  for (const std::string& warning : warnings) xml.comment(warning);
  xml.close();
  write_text_atomically(out / "render.py", mitsuba::render_script());
  write_text_atomically(out / "scene.xml", xml.text());
  return summary(scene, out, shapes, warnings);
}

}  // namespace relight
