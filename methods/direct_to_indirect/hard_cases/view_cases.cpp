// Views that show nothing, or almost nothing, and materials that reflect nothing, or everything.
#include "common/hard_cases/image_difference.h"
#include "common/hard_cases/tiny_scenes.h"
#include "methods/direct_to_indirect/hard_cases/bench.h"
#include "methods/direct_to_indirect/hard_cases/hard_cases.h"

namespace relight::direct_to_indirect {

namespace {

using namespace hard;

Figures thin_strip_of_scene() {
  Scene scene = tiny::room();
  scene.camera.target += glm::vec3(2.75f, 0.0f, 0.0f);  // the room ends in the leftmost pixels
  finish_scene(scene);
  MethodBench bench = transfer_bench(std::move(scene));
  RelitByBoth relit = relit_by_both(bench, tiny::omni({0.0f, 0.2f, 0.6f}));
  double background = 0.0, lit = 0.0, wrong = 0.0;
  for (size_t i = 0; i < relit.cpu.total.pixels.size(); ++i) {
    bool hit = bench.buffer.indirect[i].valid;
    for (size_t s = 0; s < 4; ++s)
      hit = hit || bench.buffer.direct[(2 * (i / 40) + s / 2) * 80 + 2 * (i % 40) + s % 2].valid;
    const bool black = relit.cpu.total.pixels[i] == glm::vec3(0.0f);
    background += !hit, lit += !black, wrong += !hit && !black;
  }
  relit.figures.push_back(at_most("background pixels that are not black", wrong, 0.0,
                                  "a pixel without samples takes no neighbour's light"));
  relit.figures.push_back(
      at_least("background pixels", background, 801.0, "else the view is not almost empty"));
  relit.figures.push_back(at_least("lit pixels", lit, 11.0, "else the view is empty"));
  return relit.figures;
}

// Neither an importance map nor a row has anything to stand on.
Figures only_background() {
  double light = 0.0, warnings = 0.0, hits = 0.0;
  for (const char* preset : {"paper", "best"}) {
    Scene scene = tiny::room();
    scene.camera.target = scene.camera.eye + glm::vec3(0.0f, 0.1f, 1.0f);
    finish_scene(scene);
    MethodBench bench = transfer_bench(std::move(scene));
    for (const SurfaceSample& s : bench.buffer.direct) hits += s.valid;
    KnobList knobs = {{"device", "cpu"}};
    for (const KnobPreset& p : bench.method->presets())
      if (p.name == preset) knobs.insert(knobs.end(), p.values.begin(), p.values.end());
    const Relit relit = bench.relight(knobs, tiny::lighting({tiny::omni({0.3f, 0.6f, 0.4f})}));
    light += norm(relit.total), warnings += static_cast<double>(bench.relight_log.warnings().size());
  }
  return {at_most("light of the picture", light, 0.0, "nothing is seen"),
          at_most("warnings", warnings, 0.0, "an empty view is no failure"),
          at_most("view samples", hits, 0.0, "else the camera sees something")};
}

// Upsampling takes indirect light from any of the 3x3 pixels.
bool black_around(const DeepFrameBuffer& buffer, size_t pixel) {
  const int w = buffer.view.width, h = buffer.view.height;
  const int x = static_cast<int>(pixel) % w, y = static_cast<int>(pixel) / w;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (x + dx < 0 || x + dx >= w || y + dy < 0 || y + dy >= h) return false;
      const SurfaceSample& s = buffer.indirect[static_cast<size_t>((y + dy) * w + x + dx)];
      if (!s.valid || s.diffuse != glm::vec3(0.0f)) return false;
    }
  return true;
}

Scene chequered_room() {
  Scene scene = tiny::room();
  Texture checks;
  checks.width = checks.height = 64;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) checks.texels.emplace_back((x / 16 + y / 16) % 2 ? 1.0f : 0.0f);
  scene.textures.push_back(checks);
  for (Material& m : scene.materials) m.diffuse = glm::vec3(1.0f), m.diffuse_texture = 0;
  finish_scene(scene);
  return scene;
}

// Four bounces. The room loses light through its open side, so that the series converges.
Figures albedos_zero_and_one() {
  MethodBench bench = transfer_bench(chequered_room());
  const LightingState lighting = tiny::lighting({tiny::omni({0.3f, 0.6f, 0.4f})});
  Figures figures;
  for (const char* kind : {"photons", "transfer"}) {
    const Relit relit = bench.relight(four_bounces(kind), lighting);
    add_worst(figures, non_finite_pixels({&relit.total}));
    add_worst(figures, at_most("indirect over direct light", norm(relit.indirect) / norm(relit.direct), 4.0,
                               "each of four bounces brings less than the light itself"));
    double black = 0.0, wrong = 0.0;
    for (size_t i = 0; i < relit.indirect.pixels.size(); ++i) {
      if (!black_around(bench.buffer, i)) continue;
      ++black;
      wrong += relit.indirect.pixels[i] != glm::vec3(0.0f);
    }
    add_worst(figures, at_most("pixels of albedo 0 that are not black", wrong, 0.0, "0 times anything"));
    add_worst(figures, at_least("pixels of albedo 0", black, 31.0, "else none is looked at"));
  }
  return figures;
}

}  // namespace

Cases view_cases() {
  return {{"a thin strip of scene before background", "Pixels without samples take a neighbour's light.",
           thin_strip_of_scene},
          {"a camera that sees only background", "Division by the number of view samples.", only_background},
          {"a texture of albedos 0 and 1", "Light where nothing reflects; a series that does not converge.",
           albedos_zero_and_one}};
}

}  // namespace relight::direct_to_indirect
