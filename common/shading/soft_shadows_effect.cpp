#include "common/shading/soft_shadows_effect.h"

#include "common/sampling/deep_frame_buffer.h"
#include "common/shading/direct_lighting.h"
#include "common/shading/reconstruction.h"

namespace relight {

namespace {

constexpr int points[] = {1, 4, 16, 64};

LightingState lights_with_area(const LightingState& lighting) {
  LightingState area;
  for (const Light& light : lighting.lights)
    if (has_area(light.type) && light.intensity != glm::vec3(0.0f)) area.lights.push_back(light);
  return area;
}

Image direct_light(const EffectSite& site, const LightingState& lighting, int samples) {
  const View& view = site.buffer.view;
  return box_filter_2x2(
      shade_direct_cpu(site.tracer, site.buffer.direct, view.camera.eye, lighting, Lobes::all, samples),
      view.width, view.height);
}

std::vector<Image> lacks(const EffectSite& site) {
  const LightingState area = lights_with_area(site.lighting);
  std::vector<Image> images;
  for (const int n : points) images.push_back(direct_light(site, area, n));
  const Image all = images.back();
  for (Image& image : images)
    for (size_t i = 0; i < all.pixels.size(); ++i) image.pixels[i] = all.pixels[i] - image.pixels[i];
  return images;
}

}  // namespace

Effect soft_shadows_effect(const std::string& knob) {
  Effect effect{"soft_shadows", "Points that stand for a light with an area; 1: hard shadows.", {}};
  for (const int n : points) effect.levels.push_back({std::to_string(n), {{knob, std::to_string(n)}}});
  effect.lacks = lacks;
  effect.needless = [](const EffectSite& site) -> std::string {
    return lights_with_area(site.lighting).lights.empty() ? "no light has an area, so all shadows are sharp"
                                                          : "";
  };
  return effect;
}

}  // namespace relight
