#include "common/scene/scene.h"

#include "common/scene/content_hash.h"

namespace relight {

namespace {

// Names and file names are left out: they change no picture. Exposure is left out: radiance does not depend
// on it.
uint64_t hash_content(const Scene& scene) {
  ContentHash hash;
  hash.add(scene.positions);
  hash.add(scene.normals);
  hash.add(scene.uvs);
  hash.add(scene.triangles);
  for (const Material& m : scene.materials) {
    hash.add(m.diffuse);
    hash.add(m.diffuse_texture);
    hash.add(m.glossy);
    hash.add(m.exponent);
    hash.add(m.shape);
    hash.add(m.emission);
  }
  for (const Texture& t : scene.textures) {
    hash.add(t.width);
    hash.add(t.height);
    hash.add(t.texels);
  }
  const Environment& e = scene.environment;
  hash.add(e.radiance);
  hash.add(e.rotation_y);
  hash.add(e.width);
  hash.add(e.height);
  hash.add(e.texels);
  return hash.value();
}

}  // namespace

void finish_scene(Scene& scene) {
  scene.bounds = Bounds();
  for (const Triangle& t : scene.triangles)
    for (uint32_t v : t.v) scene.bounds.add(scene.positions[v]);
  scene.content_hash = hash_content(scene);
}

}  // namespace relight
