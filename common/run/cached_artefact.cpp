#include "common/run/cached_artefact.h"

#include <fmt/format.h>

#include "common/sampling/random.h"

namespace relight {
namespace {

std::string words(const glm::vec3& v) { return fmt::format("({},{},{})", v.x, v.y, v.z); }

}  // namespace

std::string view_words(const PrepareContext& context) {
  const View& view = context.buffer.view;
  const Camera& camera = view.camera;
  return fmt::format("scene={:016x};view={}x{};eye={};target={};up={};fov={};seed={}",
                     context.scene.content_hash, view.width, view.height, words(camera.eye),
                     words(camera.target), words(camera.up), camera.fov_y_degrees, context.seed);
}

std::string pixel_words(const PrepareContext& context) {
  const std::vector<uint8_t>& wanted = context.buffer.wanted;
  uint64_t hash = wanted.size();
  for (size_t i = 0; i < wanted.size(); ++i)
    if (wanted[i]) hash = hash_combine(hash, i);
  return fmt::format("{};wanted={:016x}", view_words(context), hash);
}

}  // namespace relight
