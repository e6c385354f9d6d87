#include "common/linalg/quad_product_gpu.h"

#include <glad/gl.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/linalg/atlas_packing.h"
#include "common/linalg/block_quantisation.h"
#include "common/linalg/image_blocks.h"
#include "common/run/error.h"

namespace relight {
namespace {

// As in quad_vertex.glsl.
struct Quad {
  uint32_t corner, size, texel, column;
  float step, origin, norm, padding;
};
static_assert(sizeof(Quad) == 32);

constexpr size_t quads_a_batch = size_t{1} << 20;  // 32 MiB of instances: below any limit of a storage block

struct TexelFormat {
  GLenum internal, format, type;
};

TexelFormat texel_format(WeightFormat format) {
  switch (format) {
    case WeightFormat::bits8:
      return {GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE};
    case WeightFormat::bits16:
      return {GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT};
    case WeightFormat::float32:
      break;
  }
  return {GL_R32F, GL_RED, GL_FLOAT};
}

uint32_t pair_of(int x, int y) { return static_cast<uint32_t>(x) | static_cast<uint32_t>(y) << 16; }

// One atlas in host memory.
class AtlasImage {
 public:
  AtlasImage(int width, int height, WeightFormat format)
      : width_(width),
        height_(height),
        format_(format),
        bytes_(texels() * static_cast<size_t>(bytes_of(format))) {}

  void put(int x, int y, float weight, const BlockQuantisation& block) {
    const size_t at = static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
    const uint32_t integer = format_ == WeightFormat::float32 ? 0 : quantised(weight, block, format_);
    if (format_ == WeightFormat::float32)
      std::copy_n(reinterpret_cast<const std::byte*>(&weight), 4, bytes_.data() + 4 * at);
    else  // little-endian: the low bytes come first
      std::copy_n(reinterpret_cast<const std::byte*>(&integer), bytes_of(format_),
                  bytes_.data() + static_cast<size_t>(bytes_of(format_)) * at);
  }

  gpu::Texture upload() const {
    const TexelFormat texel = texel_format(format_);
    gpu::Texture texture = gpu::Texture::image_2d(width_, height_, texel.internal);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture.id(), 0, 0, 0, width_, height_, texel.format, texel.type, bytes_.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    return texture;
  }
  int64_t bytes() const { return static_cast<int64_t>(bytes_.size()); }

 private:
  size_t texels() const { return static_cast<size_t>(width_) * static_cast<size_t>(height_); }
  int width_, height_;
  WeightFormat format_;
  std::vector<std::byte> bytes_;
};

// Quantises the block, writes its texels and returns its quad.
Quad store_block(const SparseRows& transposed, PictureShape shape, std::span<const glm::vec3> scale,
                 const ImageBlock& block, const AtlasPlace& place, WeightFormat format, AtlasImage& atlas,
                 std::vector<float>& weights) {
  block_weights(transposed, shape, block, weights);
  BlockQuantisation quantisation;
  if (format != WeightFormat::float32) quantisation = quantise_block(weights, format);
  double square = 0.0;
  for (int i = 0; i < block.width * block.height; ++i) {
    const int dx = i % block.width, dy = i / block.width;
    const float weight = weights[static_cast<size_t>(i)];
    atlas.put(place.x + dx, place.y + dy, weight, quantisation);
    const size_t row = static_cast<size_t>(block.y + dy) * static_cast<size_t>(shape.width) +
                       static_cast<size_t>(block.x + dx);
    const double v = static_cast<double>(weight) * static_cast<double>(row_response(scale[row]));
    square += v * v;
  }
  return {pair_of(block.x, block.y),
          pair_of(block.width, block.height),
          pair_of(place.x, place.y),
          block.column,
          quantisation.step,
          quantisation.origin,
          static_cast<float>(std::sqrt(square)),
          0.0f};
}

void check_vertex_storage() {
  GLint blocks = 0;
  glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
  if (blocks < 4)
    fail("product quads: this driver has {} storage blocks in vertex shaders, 4 are needed", blocks);
}

}  // namespace

QuadProductGpu::QuadProductGpu(const SparseRows& matrix, std::span<const glm::vec3> scale, PictureShape shape,
                               const ProductSettings& settings)
    : shape_(shape),
      columns_(matrix.columns),
      scale_(padded_row_scale(matrix, scale)),
      culling_(matrix, scale, settings),
      draw_(gpu::Program::graphics("common/linalg/quad_vertex.glsl", "common/linalg/quad_fragment.glsl",
                                   {fmt::format("WEIGHT_BITS {}", 8 * bytes_of(settings.weights))})),
      resolve_(gpu::Program::compute("common/linalg/quad_resolve.glsl")),
      vertex_array_(gpu::create_object(gpu::ObjectKind::vertex_array)) {
  check_vertex_storage();
  const SparseRows transposed = transpose(matrix);
  const std::vector<ImageBlock> blocks = cut_into_blocks(transposed, shape, settings.block_waste);
  std::vector<AtlasSize> sizes;
  for (const ImageBlock& b : blocks) sizes.push_back({b.width, b.height});
  const AtlasPacking packing = pack_into_atlases(sizes, settings.atlas_size);

  std::vector<std::vector<size_t>> of_atlas(packing.heights.size());
  for (size_t i = 0; i < blocks.size(); ++i)
    of_atlas[static_cast<size_t>(packing.places[i].atlas)].push_back(i);
  for (size_t a = 0; a < of_atlas.size(); ++a) {
    AtlasImage image(settings.atlas_size, packing.heights[a], settings.weights);
    std::vector<Quad> quads(of_atlas[a].size());
    tbb::parallel_for(size_t{0}, quads.size(), [&](size_t i) {
      thread_local std::vector<float> weights;
      const size_t b = of_atlas[a][i];
      quads[i] = store_block(transposed, shape, scale, blocks[b], packing.places[b], settings.weights, image,
                             weights);
    });
    atlases_.push_back(image.upload());
    statistics_.bytes += image.bytes();
    for (size_t first = 0; first < quads.size(); first += quads_a_batch) {
      const size_t count = std::min(quads_a_batch, quads.size() - first);
      batches_.push_back({a, static_cast<int>(count),
                          gpu::Buffer(static_cast<int64_t>(count * sizeof(Quad)), quads.data() + first)});
      statistics_.bytes += batches_.back().instances.bytes();
    }
  }
  if (matrix.rows() > 0) {
    sums_ =
        gpu::Texture::image_2d(shape.width, shape.height,
                               settings.partial_results == PartialResults::float16 ? GL_RGBA16F : GL_RGBA32F);
    framebuffer_.attach_color(sums_);
  }
  statistics_.bytes += scale_.bytes() + culling_.bytes();
  statistics_.non_zeros = static_cast<int64_t>(matrix.entries.size());
  for (const ImageBlock& b : blocks) statistics_.stored += b.area();
  statistics_.blocks = static_cast<int64_t>(blocks.size());
  statistics_.atlases = static_cast<int64_t>(packing.heights.size());
  statistics_.atlas_fill = packing.fill;
}

void QuadProductGpu::draw(const gpu::Buffer& x) const {
  const float black[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, 0, black);
  framebuffer_.bind(shape_.width, shape_.height);
  glBindVertexArray(vertex_array_.id());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  draw_.use();
  draw_.set("atlas", 0);
  draw_.set("picture_size", glm::vec2(static_cast<float>(shape_.width), static_cast<float>(shape_.height)));
  x.bind_storage(1);
  for (const Batch& batch : batches_) {
    atlases_[batch.atlas].bind(0);
    batch.instances.bind_storage(0);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, batch.quads);
  }
  glDisable(GL_BLEND);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void QuadProductGpu::multiply(const gpu::Buffer& x, const gpu::Buffer& y) const {
  const auto rows = static_cast<size_t>(scale_.bytes() / 16);
  check_product_shape(columns_, rows, static_cast<size_t>(x.bytes() / 16),
                      static_cast<size_t>(y.bytes() / 16));
  culling_.begin(x);
  if (rows == 0) return;
  draw(x);
  resolve_.use();
  sums_.bind(0);
  scale_.bind_storage(0);
  y.bind_storage(1);
  resolve_.set("sums", 0);
  resolve_.set("width", static_cast<uint32_t>(shape_.width));
  resolve_.set("rows", static_cast<uint32_t>(rows));
  resolve_.dispatch_items(static_cast<int64_t>(rows), 64);
}

}  // namespace relight
