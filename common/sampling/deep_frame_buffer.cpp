#include "common/sampling/deep_frame_buffer.h"

#include <tbb/parallel_for.h>

#include "common/run/error.h"
#include "common/tracing/ray_tracer.h"

namespace relight {

namespace {

// Samples the image plane at the centres of a width x height grid.
std::vector<SurfaceSample> cast_grid(const RayTracer& tracer, const Camera& camera, int width, int height) {
  std::vector<SurfaceSample> samples(static_cast<size_t>(width) * static_cast<size_t>(height));
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const glm::vec3 direction =
          camera.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, width, height);
      SurfaceSample sample = tracer.surface(tracer.intersect(camera.eye, direction), direction);
      if (sample.valid) sample.depth = glm::length(sample.position - camera.eye);
      samples[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] = sample;
    }
  });
  return samples;
}

}  // namespace

DeepFrameBuffer make_deep_frame_buffer(const Scene&, const RayTracer& tracer, const View& view) {
  if (view.width < 1 || view.height < 1 || view.width > 16384 || view.height > 16384)
    fail("view: size {}x{} is out of range; width and height must be 1 to 16384", view.width, view.height);
  DeepFrameBuffer buffer;
  buffer.view = view;
  buffer.indirect = cast_grid(tracer, view.camera, view.width, view.height);
  // A grid of twice the resolution has its centres at 0.25 and 0.75 of each pixel.
  buffer.direct = cast_grid(tracer, view.camera, 2 * view.width, 2 * view.height);
  buffer.edge = edge_mask(buffer);
  return buffer;
}

glm::vec3 DeepFrameBuffer::eye_direction(int sub_x, int sub_y) const {
  const auto direction = [&](const glm::ivec2& sub, const glm::ivec2& size) {
    return view.camera.direction(static_cast<float>(sub.x) + 0.5f, static_cast<float>(sub.y) + 0.5f,
                                 2 * size.x, 2 * size.y);
  };
  if (place.empty()) return direction({sub_x, sub_y}, {view.width, view.height});
  const glm::ivec2 pixel = place[static_cast<size_t>(sub_y / 2) * static_cast<size_t>(view.width) +
                                 static_cast<size_t>(sub_x / 2)];
  if (pixel.x < 0) return glm::vec3(0.0f);
  return direction(2 * pixel + glm::ivec2(sub_x % 2, sub_y % 2), place_size);
}

double DeepFrameBuffer::edge_share() const {
  if (edge.empty()) return 0.0;
  int64_t count = 0;
  for (uint8_t e : edge) count += e != 0;
  return static_cast<double>(count) / static_cast<double>(edge.size());
}

}  // namespace relight
