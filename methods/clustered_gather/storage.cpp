#include "methods/clustered_gather/storage.h"

#include <bit>

#include <Imath/half.h>

namespace relight::clustered_gather {
namespace {

std::vector<uint32_t> pack_full(const Links& links) {
  const size_t n = links.per_pixel, texels = (n + 1) / 2;
  std::vector<uint32_t> words(links.pixel.size() * texels * 4, 0u);
  for (size_t i = 0; i < links.cluster.size(); ++i) {
    const size_t at = i / n * texels * 4 + i % n * 2;
    words[at] = links.cluster[i];
    words[at + 1] = std::bit_cast<uint32_t>(links.weight[i]);
  }
  return words;
}

std::vector<uint32_t> pack_half(const Links& links) {
  const size_t n = links.per_pixel, texels = (n + 1) / 2;
  std::vector<uint32_t> words(links.pixel.size() * texels * 3, 0u);
  for (size_t i = 0; i < links.cluster.size(); ++i) {
    const size_t odd = i % n % 2, first = (i / n * texels + i % n / 2) * 3;
    words[first + odd] = links.cluster[i];
    words[first + 2] |= static_cast<uint32_t>(Imath::half(links.weight[i]).bits()) << (16 * odd);
  }
  return words;
}

}  // namespace

SampleFormat storage(const KnobValues& knobs) { return sample_format(knobs.choice("storage")); }

GpuSamples gpu_samples(std::vector<SurfaceSample>& samples, const glm::vec3& eye, SampleFormat format) {
  if (format == SampleFormat::full) return {std::move(samples), eye};
  const CompactSamples stored = compact(samples, format);
  samples = {};
  return {stored, eye};
}

std::vector<SurfaceSample> cpu_samples(std::vector<SurfaceSample> samples, SampleFormat format) {
  return format == SampleFormat::full ? std::move(samples) : unpacked(compact(samples, format));
}

void round_weights(Links& links, SampleFormat format) {
  if (format == SampleFormat::full) return;
  for (float& w : links.weight) w = static_cast<float>(Imath::half(w));
}

std::vector<uint32_t> pack_links(const Links& links, SampleFormat format) {
  return format == SampleFormat::full ? pack_full(links) : pack_half(links);
}

}  // namespace relight::clustered_gather
