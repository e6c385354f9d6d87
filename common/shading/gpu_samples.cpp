#include <algorithm>

#include "common/shading/direct_lighting.h"

namespace relight {
namespace {

// 64 bytes, read by direct_lighting.glsl.
struct PackedSample {
  glm::vec4 position_exponent, ns_ngx, ngyz_diffuse_rg, diffuse_b_glossy;
};

PackedSample pack(const SurfaceSample& s) {
  if (!s.valid) return {glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(0.0f)};
  return {glm::vec4(s.position, s.exponent), glm::vec4(s.shading_normal, s.geometric_normal.x),
          glm::vec4(s.geometric_normal.y, s.geometric_normal.z, s.diffuse.r, s.diffuse.g),
          glm::vec4(s.diffuse.b, s.glossy)};
}

// BrdfShape is uploaded as it is: scalars only, so that std430 and C++ lay it out alike.
static_assert(sizeof(shader::BrdfShape) == 32);

// Uploads convert(sample) for one piece of the samples after another: a whole view at once would need another
// 80 MB for a moment.
template <typename T, typename Convert>
void upload_pieces(const std::vector<SurfaceSample>& samples, const gpu::Buffer& buffer, Convert convert) {
  constexpr size_t piece = 1 << 16;
  std::vector<T> values;
  for (size_t begin = 0; begin < samples.size(); begin += piece) {
    const size_t end = std::min(samples.size(), begin + piece);
    values.clear();
    for (size_t i = begin; i < end; ++i) values.push_back(convert(samples[i]));
    buffer.upload(static_cast<int64_t>(begin * sizeof(T)), static_cast<int64_t>(values.size() * sizeof(T)),
                  values.data());
  }
}

bool is_glossy(const SurfaceSample& s) { return s.valid && s.glossy != glm::vec3(0.0f); }

bool needs_shape(const SurfaceSample& s) {
  return is_glossy(s) && shader::brdf_model(s.shape) != shader::brdf_phong;
}

// How a format lies in its buffer.
struct Layout {
  gpu::TexelView::Format texel;
  int64_t texels, bytes;  // a sample
};

Layout layout_of(SampleFormat format) {
  using enum gpu::TexelView::Format;
  if (format == SampleFormat::half) return {r32ui, 5, 20};
  if (format == SampleFormat::bytes) return {rgb32ui, 1, 12};
  return {rgba32f, 4, sizeof(PackedSample)};
}

// Samples that one dispatch can write (16 bytes each) and one view can show. A multiple of 8192 keeps every
// range aligned, that of the visibility bits too.
int64_t largest_slab(int64_t texels) {
  const int64_t fit = std::min(gpu::Context::current()->max_storage_block_bytes() / 16,
                               gpu::TexelView::max_texels() / texels);
  return std::max<int64_t>(fit / 8192, 1) * 8192;
}

}  // namespace

GpuSamples::GpuSamples(std::vector<SurfaceSample> samples, const glm::vec3& eye, int64_t slab_samples)
    : samples_(std::move(samples)),
      size_(samples_.size()),
      eye_(eye),
      data_(static_cast<int64_t>(samples_.size() * sizeof(PackedSample))) {
  upload_pieces<PackedSample>(samples_, data_, pack);
  has_glossy_ = std::any_of(samples_.begin(), samples_.end(), is_glossy);
  if (std::any_of(samples_.begin(), samples_.end(), needs_shape)) {
    shapes_ = gpu::Buffer(static_cast<int64_t>(samples_.size() * sizeof(shader::BrdfShape)));
    upload_pieces<shader::BrdfShape>(samples_, shapes_, [](const SurfaceSample& s) { return s.shape; });
  }
  cut(slab_samples);
}

GpuSamples::GpuSamples(const CompactSamples& samples, const glm::vec3& eye, int64_t slab_samples)
    : samples_(unpacked(samples)),
      size_(samples_.size()),
      eye_(eye),
      format_(samples.format),
      frame_(samples.frame),
      unit_(samples.unit),
      data_(gpu::Buffer::from(samples.words)) {
  cut(slab_samples);
}

void GpuSamples::cut(int64_t slab_samples) {
  const auto size = static_cast<int64_t>(size_);
  const int64_t largest = slab_samples > 0 ? slab_samples : largest_slab(layout_of(format_).texels);
  for (int64_t first = 0; first < size; first += largest)
    slabs_.push_back(slab(first, std::min(largest, size - first)));
}

GpuSamples::Slab GpuSamples::slab(int64_t first, int64_t count) const {
  const Layout layout = layout_of(format_);
  constexpr auto shape_bytes = static_cast<int64_t>(sizeof(shader::BrdfShape));
  const auto data = [&] {
    return gpu::TexelView(data_, layout.texel, first * layout.bytes, count * layout.bytes);
  };
  if (!has_shapes()) return {first, count, data(), data()};
  return {first,
          count,
          data(),
          {shapes_, gpu::TexelView::Format::rgba32ui, first * shape_bytes, count * shape_bytes}};
}

int64_t GpuSamples::bytes() const { return data_.bytes() + shapes_.bytes(); }

}  // namespace relight
