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

bool needs_shape(const SurfaceSample& s) {
  return s.valid && s.glossy != glm::vec3(0.0f) && shader::brdf_model(s.shape) != shader::brdf_phong;
}

}  // namespace

GpuSamples::GpuSamples(const std::vector<SurfaceSample>& samples, const glm::vec3& eye)
    : samples_(samples), eye_(eye), data_(static_cast<int64_t>(samples.size() * sizeof(PackedSample))) {
  upload_pieces<PackedSample>(samples, data_, pack);
  if (std::none_of(samples.begin(), samples.end(), needs_shape)) return;
  shapes_ = gpu::Buffer(static_cast<int64_t>(samples.size() * sizeof(shader::BrdfShape)));
  upload_pieces<shader::BrdfShape>(samples, shapes_, [](const SurfaceSample& s) { return s.shape; });
}

int64_t GpuSamples::bytes() const { return data_.bytes() + shapes_.bytes(); }

void GpuSamples::bind_range(int samples_binding, int shapes_binding, int64_t first, int64_t count) const {
  const auto bind = [&](const gpu::Buffer& buffer, int binding, size_t size) {
    buffer.bind_storage(binding, first * static_cast<int64_t>(size), count * static_cast<int64_t>(size));
  };
  bind(data_, samples_binding, sizeof(PackedSample));
  if (has_shapes()) {
    bind(shapes_, shapes_binding, sizeof(shader::BrdfShape));
  } else {
    bind(data_, shapes_binding, sizeof(PackedSample));
  }
}

}  // namespace relight
