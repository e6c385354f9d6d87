#include "common/wavelet/picture_haar_gpu.h"

#include "common/gpu/texel_view.h"

namespace relight::wavelet {

PictureHaarGpu::PictureHaarGpu(const PictureHaar& haar, std::span<const glm::vec3> factor)
    : width_(haar.width()),
      height_(haar.height()),
      program_(gpu::Program::compute("common/wavelet/picture_haar.glsl")) {
  const int across = (width_ + picture_tile - 1) / picture_tile;
  std::vector<glm::vec4> texels;
  texels.reserve(factor.size());
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      texels.emplace_back(factor[texels.size()],
                          haar.transformed(y / picture_tile * across + x / picture_tile) ? 1.0f : 0.0f);
  factor_ = gpu::Buffer::from(texels);
}

void PictureHaarGpu::inverse(const gpu::Buffer& coefficients, const gpu::Buffer& pixels) const {
  using gpu::TexelView;
  const TexelView source(coefficients, TexelView::Format::rgba32f),
      factor(factor_, TexelView::Format::rgba32f);
  const int64_t count = static_cast<int64_t>(width_) * height_;
  program_.use();
  source.bind(0);
  factor.bind(1);
  pixels.bind_storage(2);
  program_.set("pixel_count", static_cast<uint32_t>(count));
  program_.set("width", width_);
  program_.set("height", height_);
  program_.dispatch_items(count, 64);
}

}  // namespace relight::wavelet
