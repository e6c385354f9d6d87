#include "common/shading/sample_formats.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Imath/half.h>

#include "common/glsl_in_cpp.h"

namespace relight {
namespace shader {
using namespace glm;
#include "common/shading/sample_formats.glsl"
}  // namespace shader

namespace {

constexpr size_t half_words = 5, byte_words = 3;

// The next 16-bit float that is not below `value` (upwards), or not above it. |value| <= 1.
uint16_t half_beyond(float value, bool upwards) {
  Imath::half h(value);
  uint16_t bits = h.bits();
  const auto rounded = static_cast<float>(h);
  if (rounded == value || (rounded > value) == upwards) return bits;
  if (rounded == 0.0f) return upwards ? 0x0001 : 0x8001;
  // Magnitudes ascend with their bits, so that the next number up is one more if positive, else one less.
  return static_cast<uint16_t>(upwards == (rounded > 0.0f) ? bits + 1 : bits - 1);
}

uint32_t halves(uint16_t low, uint16_t high) {
  return static_cast<uint32_t>(low) | static_cast<uint32_t>(high) << 16;
}

uint16_t half_bits(float value) { return Imath::half(value).bits(); }

void add_half(const SurfaceSample& s, const glm::vec4& frame, float unit, std::vector<uint32_t>& words) {
  const glm::vec3 p = (s.position - glm::vec3(frame)) / frame.w, n = s.shading_normal;
  const glm::vec3 k = s.diffuse / unit;
  const auto place = [&](int i) { return half_beyond(std::clamp(p[i], -1.0f, 1.0f), n[i] > 0.0f); };
  words.insert(words.end(), {halves(place(0), place(1)), halves(place(2), half_bits(n.x)),
                             halves(half_bits(n.y), half_bits(n.z)), halves(half_bits(k.r), half_bits(k.g)),
                             halves(half_bits(k.b), 0)});
}

// The inverse of octahedral_direction, to the nearest of 255 steps a side.
uint32_t octahedral_bytes(const glm::vec3& n) {
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  glm::vec2 p(n.x / sum, n.y / sum);
  if (n.z < 0.0f)
    p = {(1.0f - std::abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f),
         (1.0f - std::abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f)};
  const auto byte = [](float x) { return static_cast<uint32_t>(std::lround(127.0f * (x + 1.0f))); };
  return byte(p.x) | byte(p.y) << 8;
}

uint32_t shared_exponent(const glm::vec3& k) {
  const float largest = std::max({k.r, k.g, k.b});
  if (!(largest > 0.0f)) return 0;
  int exponent = 0;
  std::frexp(largest, &exponent);
  // A largest channel that would round to 256 needs the next exponent.
  if (std::lround(std::ldexp(largest, 8 - exponent)) > 255) ++exponent;
  const auto biased = static_cast<uint32_t>(std::clamp(exponent + 127, 1, 254));
  const auto byte = [&](float x) {
    return static_cast<uint32_t>(std::clamp(std::lround(std::ldexp(x, 8 - exponent)), 0l, 255l));
  };
  return byte(k.r) | byte(k.g) << 8 | byte(k.b) << 16 | biased << 24;
}

void add_bytes(const SurfaceSample& s, const glm::vec4& frame, std::vector<uint32_t>& words) {
  const glm::vec3 p = (s.position - glm::vec3(frame)) / frame.w;
  const auto place = [&](int i) {
    const float at = (std::clamp(p[i], -1.0f, 1.0f) + 1.0f) * 0.5f * 65535.0f;
    const float whole = s.shading_normal[i] > 0.0f ? std::ceil(at) : std::floor(at);
    return static_cast<uint32_t>(std::clamp(whole, 0.0f, 65535.0f));
  };
  words.insert(words.end(), {place(0) | place(1) << 16, place(2) | octahedral_bytes(s.shading_normal) << 16,
                             shared_exponent(s.diffuse)});
}

// Of the valid samples.
glm::vec4 frame_of(std::span<const SurfaceSample> samples) {
  glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
  for (const SurfaceSample& s : samples)
    if (s.valid) low = glm::min(low, s.position), high = glm::max(high, s.position);
  if (low.x > high.x) return {0.0f, 0.0f, 0.0f, 1.0f};
  const glm::vec3 centre = 0.5f * low + 0.5f * high, extent = 0.5f * high - 0.5f * low;
  const float half = std::max({extent.x, extent.y, extent.z});
  // Of coincident samples, what a float resolves there, so that they hardly move.
  const float resolved = 0x1p-20f * std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)});
  return {centre, std::max({half, resolved, std::numeric_limits<float>::min()})};
}

float largest_coefficient(std::span<const SurfaceSample> samples) {
  float largest = 0.0f;
  for (const SurfaceSample& s : samples)
    if (s.valid) largest = std::max({largest, s.diffuse.r, s.diffuse.g, s.diffuse.b});
  return largest > 0.0f ? largest : 1.0f;
}

}  // namespace

SampleFormat sample_format(const std::string& name) {
  if (name == "full") return SampleFormat::full;
  if (name == "half") return SampleFormat::half;
  if (name == "bytes") return SampleFormat::bytes;
  throw std::logic_error("sample_format: no format '" + name + "'");
}

size_t sample_words(SampleFormat format) {
  if (format == SampleFormat::full) throw std::logic_error("sample_words: the full format is not compact");
  return format == SampleFormat::half ? half_words : byte_words;
}

CompactSamples compact(std::span<const SurfaceSample> samples, SampleFormat format) {
  CompactSamples out{format, frame_of(samples), largest_coefficient(samples), {}};
  out.words.reserve(samples.size() * sample_words(format));
  for (SurfaceSample s : samples) {
    if (!s.valid) {
      s = {};
      s.position = glm::vec3(out.frame);
      s.shading_normal = {0.0f, 0.0f, 1.0f};
    }
    if (format == SampleFormat::half)
      add_half(s, out.frame, out.unit, out.words);
    else
      add_bytes(s, out.frame, out.words);
  }
  return out;
}

std::vector<SurfaceSample> unpacked(const CompactSamples& samples) {
  std::vector<SurfaceSample> out(samples.size());
  const size_t stride = sample_words(samples.format);
  for (size_t i = 0; i < out.size(); ++i) {
    const uint32_t* w = samples.words.data() + i * stride;
    const shader::CompactSample c =
        samples.format == SampleFormat::half
            ? shader::half_sample(w[0], w[1], w[2], w[3], w[4], samples.frame, samples.unit)
            : shader::byte_sample(w[0], w[1], w[2], samples.frame);
    SurfaceSample& s = out[i];
    s.position = c.position, s.diffuse = c.diffuse;
    s.shading_normal = s.geometric_normal = c.normal;
    s.valid = true;
  }
  return out;
}

}  // namespace relight
