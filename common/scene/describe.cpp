// The text of `relight scene info`.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "common/lights/light_animation.h"
#include "common/lights/light_words.h"
#include "common/scene/scene_file.h"
#include "common/scene/topology.h"

namespace relight {

namespace {

std::string show(const glm::vec3& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z); }

struct AreaSums {
  double total = 0.0, glossy = 0.0, textured = 0.0, emitting = 0.0;
};

AreaSums sum_areas(const Scene& scene) {
  AreaSums sums;
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const Material& material = scene.materials[scene.triangles[t].material];
    const double area = 0.5 * double(glm::length(scene.area_normal(t)));
    sums.total += area;
    if (material.is_glossy()) sums.glossy += area;
    if (material.diffuse_texture >= 0) sums.textured += area;
    if (material.emission != glm::vec3(0.0f)) sums.emitting += area;
  }
  return sums;
}

// Smallest and largest of diffuse + glossy albedo over all channels of the materials that triangles use.
std::pair<float, float> albedo_range(const Scene& scene) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const Triangle& t : scene.triangles) used[t.material] = true;
  float low = 1e30f, high = 0.0f;
  const auto add = [&](const glm::vec3& albedo) {
    low = std::min({low, albedo.x, albedo.y, albedo.z});
    high = std::max({high, albedo.x, albedo.y, albedo.z});
  };
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    if (!used[i]) continue;
    const Material& m = scene.materials[i];
    if (m.diffuse_texture < 0) {
      add(m.diffuse + m.glossy);
      continue;
    }
    for (const glm::vec3& texel : scene.textures[static_cast<size_t>(m.diffuse_texture)].texels)
      add(m.diffuse * texel + m.glossy);
  }
  return {low, high};
}

void describe_geometry(const Scene& scene, std::string& text) {
  const auto out = std::back_inserter(text);
  const EdgeReport edges = examine_edges(weld_positions(scene.positions), scene.triangles);
  const Bounds& b = scene.bounds;
  fmt::format_to(out, "triangles      {}\n", scene.triangles.size());
  fmt::format_to(out, "vertices       {}\n", scene.positions.size());
  fmt::format_to(out, "objects        {}\n", scene.object_names.size());
  fmt::format_to(out, "bounding box   {} to {}, extent {}, diagonal {:.4g}\n", show(b.lo), show(b.hi),
                 show(b.hi - b.lo), b.diagonal());
  fmt::format_to(
      out, "edges          {} after merging equal positions: {} boundary, {} non-manifold, {} flipped\n",
      edges.edges, edges.boundary, edges.non_manifold, edges.flipped);
  fmt::format_to(out, "closed         {}\n",
                 edges.closed()        ? "yes"
                 : edges.boundary == 0 ? "no boundary, but not a manifold"
                                       : "no");
}

void describe_surfaces(const Scene& scene, std::string& text) {
  const auto out = std::back_inserter(text);
  const AreaSums areas = sum_areas(scene);
  const auto share = [&](double area) { return areas.total > 0.0 ? 100.0 * area / areas.total : 0.0; };
  const auto [low, high] = albedo_range(scene);
  fmt::format_to(out, "surface area   {:.6g}: {:.1f} % glossy, {:.1f} % textured, {:.1f} % emitting\n",
                 areas.total, share(areas.glossy), share(areas.textured), share(areas.emitting));
  fmt::format_to(out, "materials      {}, albedo (diffuse + glossy) {:.3g} to {:.3g}\n",
                 scene.materials.size(), low, high);
  fmt::format_to(out, "textures       {}\n", scene.textures.size());
  for (const Texture& t : scene.textures) fmt::format_to(out, "  {} ({} x {})\n", t.file, t.width, t.height);
}

std::string describe_time(const LightingState& lighting) {
  if (!lighting.animation) return {};
  return fmt::format("   animated from {:.4g} to {:.4g} s", lighting.animation->first_time(),
                     lighting.animation->last_time());
}

void describe_motion(const LightingState& lighting, size_t light, std::string& text) {
  if (!lighting.animation) return;
  for (const AnimatedLight& animated : lighting.animation->lights) {
    if (animated.light != light) continue;
    for (const LightTrack& track : animated.tracks)
      fmt::format_to(std::back_inserter(text), ", {} by {} keyframes{}", track.field, track.times.size(),
                     track.spline ? " (spline)" : "");
  }
}

void describe_lighting(const Scene& scene, std::string& text) {
  const auto out = std::back_inserter(text);
  const Environment& e = scene.environment;
  if (e.black())
    fmt::format_to(out, "environment    black\n");
  else if (e.texels.empty())
    fmt::format_to(out, "environment    constant radiance {}\n", show(e.radiance));
  else
    fmt::format_to(out, "environment    {} ({} x {}) times {}, turned {:.4g} degrees\n", e.file, e.width,
                   e.height, show(e.radiance), glm::degrees(e.rotation_y));
  fmt::format_to(out, "exposure       {:.4g}\n", scene.exposure);
  const auto describe_camera = [&](const std::string& what, const Camera& camera) {
    fmt::format_to(out, "{:<14} eye {}, target {}, fov {:.4g} degrees\n", what, show(camera.eye),
                   show(camera.target), camera.fov_y_degrees);
  };
  describe_camera("camera", scene.camera);
  for (const auto& [name, camera] : scene.views) describe_camera("view " + name, camera);
  fmt::format_to(out, "lightings      {}\n", scene.lightings.size());
  for (const auto& [name, lighting] : scene.lightings) {
    fmt::format_to(out, "  {}{}\n", name, describe_time(lighting));
    for (size_t i = 0; i < lighting.lights.size(); ++i) {
      const Light& light = lighting.lights[i];
      fmt::format_to(out, "    {} at {}, intensity {}", to_string(light.type), show(light.position),
                     show(light.intensity));
      if (light.type == LightType::spot)
        fmt::format_to(out, ", towards {}, {:.4g} to {:.4g} degrees", show(light.direction),
                       light.inner_degrees, light.outer_degrees);
      describe_motion(lighting, i, text);
      text += '\n';
    }
  }
}

}  // namespace

std::string describe_scene(const Scene& scene) {
  std::string text = fmt::format("scene          {}\n", scene.name);
  describe_geometry(scene, text);
  describe_surfaces(scene, text);
  describe_lighting(scene, text);
  fmt::format_to(std::back_inserter(text), "content hash   {:016x}\n", scene.content_hash);
  if (scene.repairs.counts.empty() && scene.repairs.warnings.empty())
    text += "repairs        none\n";
  else
    text += "repairs\n";
  for (const auto& [what, count] : scene.repairs.counts)
    fmt::format_to(std::back_inserter(text), "  {:<40} {}\n", what, count);
  for (const std::string& warning : scene.repairs.warnings)
    fmt::format_to(std::back_inserter(text), "  warning: {}\n", warning);
  return text;
}

}  // namespace relight
