#include "common/shading/reconstruction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/gpu/context.h"
#include "common/gpu/program.h"
#include "common/gpu/texel_view.h"
#include "common/run/error.h"
#include "common/run/stage_log.h"
#include "common/shading/non_finite_report.h"

namespace relight {
namespace {

constexpr int local_size = 64;
constexpr int direct_image_binding = 3, indirect_image_binding = 4;
constexpr int direct_unit = 0, closest_unit = 1, indirect_unit = 2;

// The sources of a pixel's four sub-samples side by side: one texel a pixel.
std::vector<glm::uvec4> closest_by_pixel(const DeepFrameBuffer& buffer,
                                         const std::vector<uint32_t>& closest) {
  const auto w = static_cast<size_t>(buffer.view.width), h = static_cast<size_t>(buffer.view.height);
  std::vector<glm::uvec4> pixels(w * h);
  for (size_t y = 0; y < h; ++y) {
    for (size_t x = 0; x < w; ++x) {
      const size_t top = 4 * y * w + 2 * x, bottom = top + 2 * w;
      pixels[y * w + x] = {closest[top], closest[top + 1], closest[bottom], closest[bottom + 1]};
    }
  }
  return pixels;
}

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

Reconstruction::Reconstruction(const DeepFrameBuffer& buffer, Upsampling upsampling)
    : Reconstruction(buffer, indirect_sources(buffer, upsampling)) {}

Reconstruction::Reconstruction(const DeepFrameBuffer& buffer, const IndirectSources& sources)
    : width_(buffer.view.width),
      height_(buffer.view.height),
      indirect_values_(int64_t{sources.width} * sources.height),
      closest_(gpu::Buffer::from(closest_by_pixel(buffer, sources.of))),
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
  if (indirect_values_ > gpu::TexelView::max_texels())
    fail("view of {} x {} pixels: {} values of indirect light exceed this GPU's largest texture buffer, {}",
         width_, height_, indirect_values_, gpu::TexelView::max_texels());
}

Reconstruction::Images Reconstruction::resolve(const gpu::Buffer& direct, const gpu::Buffer& indirect,
                                               StageLog& log) const {
  const int64_t w = width_, h = height_;
  if (direct.bytes() < 64 * w * h || indirect.bytes() < 16 * indirect_values_) {
    throw std::logic_error(
        "Reconstruction::resolve: needs a vec4 for each value of direct and indirect light");
  }
  const StageTimer timer(log, "reconstruction");
  using gpu::TexelView;
  using enum TexelView::Format;
  // Rows whose sub-samples one view shows; a multiple of 16 keeps every range aligned.
  const int64_t rows_that_fit =
      std::min(gpu::Context::current()->max_storage_block_bytes() / 16, TexelView::max_texels() / 4) / w /
      16 * 16;
  const int64_t slab = std::max<int64_t>(rows_that_fit, 16);
  program_.set("image_width", static_cast<uint32_t>(w));
  const TexelView all_indirect(indirect, rgba32f, 0, 16 * indirect_values_);
  all_indirect.bind(indirect_unit);
  for (int64_t row = 0; row < h; row += slab) {
    const int64_t pixels = std::min(slab, h - row) * w, first = row * w;
    const TexelView direct_rows(direct, rgba32f, 64 * first, 64 * pixels);
    const TexelView closest_rows(closest_, rgba32ui, 16 * first, 16 * pixels);
    direct_rows.bind(direct_unit);
    closest_rows.bind(closest_unit);
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
