// Compact forms of diffuse surface samples for memory and bandwidth, and what is left of a sample in them.
// `half` holds what the clustered gather paper (2006, section 4) packs into 18 bytes a gather sample.
//
// Both keep one normal, which stands for the geometric one too, and neither keeps a glossy part, emission or
// what a sample was seen through. Positions are rounded towards the side of the surface that the sample is
// on: rounded to nearest, half of all samples would lie below their surface, in its shadow.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/sampling/surface_sample.h"

namespace relight {

// The shader knows them by their order: FORMAT of direct_lighting.glsl.
enum class SampleFormat {
  full,   // 64 bytes: 32-bit floats, two normals, glossy part
  half,   // nine 16-bit floats in 20 bytes
  bytes,  // 12 bytes: 16-bit positions, normal in two bytes, albedo with a shared exponent
};

// "full", "half" or "bytes"; anything else is a logic error (knob tables refuse it first).
SampleFormat sample_format(const std::string& name);

// Words of 32 bits that a sample takes in a compact format.
size_t sample_words(SampleFormat format);

// Samples in a compact format. Invalid samples have no albedo.
struct CompactSamples {
  SampleFormat format = SampleFormat::half;
  glm::vec4 frame{0.0f};  // centre and half extent of the cube that holds all valid positions
  float unit = 1.0f;      // largest diffuse coefficient (half)
  std::vector<uint32_t> words;
  size_t size() const { return words.size() / sample_words(format); }
};

// Relative errors: positions 2^-11 (half) and 2^-15 (bytes) of half the extent at most; directions 0.001 and
// 0.02 rad; albedos 2^-11 and, of the largest channel, 2^-8. Coefficients below 6e-5 of the largest lose bits
// with half. Throws std::logic_error for SampleFormat::full.
CompactSamples compact(std::span<const SurfaceSample> samples, SampleFormat format);

// What is left of the samples, as shaders see it.
std::vector<SurfaceSample> unpacked(const CompactSamples& samples);

}  // namespace relight
