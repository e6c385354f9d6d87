#include "common/run/cached_artefact.h"

#include <fmt/format.h>

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

}  // namespace relight
