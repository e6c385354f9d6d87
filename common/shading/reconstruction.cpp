#include "common/shading/reconstruction.h"

#include <cmath>
#include <stdexcept>

#include "common/gpu/context.h"
#include "common/gpu/program.h"
#include "common/run/error.h"
#include "common/run/stage_log.h"
#include "common/shading/non_finite_report.h"

namespace relight {
namespace {

constexpr int local_size = 64;
constexpr int direct_binding = 0, closest_binding = 1, indirect_binding = 2, direct_image_binding = 3,
              indirect_image_binding = 4;

// Downloads vec4 pixels; a value that is not finite is counted and replaced by zero.
Image download_image(const gpu::Buffer& buffer, int width, int height, const char* which, StageLog& log) {
  const std::vector<glm::vec4> values = buffer.download<glm::vec4>();
  Image image(width, height);
  int64_t bad = 0;
  size_t first_bad = 0;
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const glm::vec3 v(values[i]);
    if (std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z)) {
      image.pixels[i] = v;
    } else if (bad++ == 0) {
      first_bad = i;
    }
  }
  if (bad > 0) report_non_finite_pixels(which, bad, first_bad, static_cast<size_t>(width), log);
  return image;
}

}  // namespace

Reconstruction::Reconstruction(const DeepFrameBuffer& buffer)
    : width_(buffer.view.width),
      height_(buffer.view.height),
      closest_(gpu::Buffer::from(closest_view_samples(buffer))),
      program_(gpu::Program::compute("common/shading/reconstruction.glsl")),
      direct_image_(int64_t{16} * width_ * height_),
      indirect_image_(int64_t{16} * width_ * height_) {
  const int64_t limit = gpu::Context::current()->max_storage_block_bytes();
  if (indirect_image_.bytes() > limit) {
    fail(
        "view of {} x {} pixels: its indirect image of {} bytes exceeds this GPU's largest storage block, {} "
        "bytes",
        width_, height_, indirect_image_.bytes(), limit);
  }
}

Reconstruction::Images Reconstruction::resolve(const gpu::Buffer& direct, const gpu::Buffer& indirect,
                                               StageLog& log) const {
  const int64_t w = width_, h = height_;
  if (direct.bytes() < 64 * w * h || indirect.bytes() < 16 * w * h) {
    throw std::logic_error("Reconstruction::resolve: needs a vec4 a sub-sample and a vec4 a pixel");
  }
  const StageTimer timer(log, "reconstruction");
  // Rows that one dispatch can bind; a multiple of 16 keeps every range aligned.
  const int64_t rows_that_fit = gpu::Context::current()->max_storage_block_bytes() / (64 * w) / 16 * 16;
  const int64_t slab = std::max<int64_t>(rows_that_fit, 16);
  program_.set("image_width", static_cast<uint32_t>(w));
  indirect.bind_storage(indirect_binding);
  for (int64_t row = 0; row < h; row += slab) {
    const int64_t pixels = std::min(slab, h - row) * w, first = row * w;
    direct.bind_storage(direct_binding, 64 * first, 64 * pixels);
    closest_.bind_storage(closest_binding, 16 * first, 16 * pixels);
    direct_image_.bind_storage(direct_image_binding, 16 * first, 16 * pixels);
    indirect_image_.bind_storage(indirect_image_binding, 16 * first, 16 * pixels);
    program_.set("pixel_count", static_cast<uint32_t>(pixels));
    program_.dispatch_items(pixels, local_size);
  }
  gpu::check_gl("reconstruction");
  return {download_image(direct_image_, width_, height_, "direct", log),
          download_image(indirect_image_, width_, height_, "indirect", log)};
}

}  // namespace relight
