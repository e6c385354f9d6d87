#include "common/brdf/brdf_lobes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace relight {

namespace {

constexpr uint32_t share_steps = 1023;  // 10 bits

shader::BrdfShape shape_of(BrdfModel model) {
  shader::BrdfShape shape{};
  shape.shares_0_model = static_cast<uint32_t>(model) << 30;
  return shape;
}

void require_valid(const LafortuneLobe& lobe) {
  const bool finite = std::isfinite(lobe.cz) && std::isfinite(lobe.exponent) &&
                      std::isfinite(lobe.albedo.x) && std::isfinite(lobe.albedo.y) &&
                      std::isfinite(lobe.albedo.z);
  const float largest = std::max(std::abs(lobe.cx), std::abs(lobe.cy));
  if (!finite || !(lobe.cz > 0.0f) || !(largest <= 8.0f * lobe.cz))
    throw std::invalid_argument(fmt::format(
        "Lafortune lobe: c is ({}, {}, {}); valid: cz > 0, |cx|, |cy| <= 8 cz", lobe.cx, lobe.cy, lobe.cz));
  if (!(lobe.exponent >= 0.0f) || glm::any(glm::lessThan(lobe.albedo, glm::vec3(0.0f))))
    throw std::invalid_argument(
        fmt::format("Lafortune lobe: exponent is {}, albedo ({}, {}, {}); valid: >= 0", lobe.exponent,
                    lobe.albedo.x, lobe.albedo.y, lobe.albedo.z));
}

// The share of `part` in `total` in steps of 1/1023.
uint32_t steps(float part, float total) {
  if (!(total > 0.0f)) return 0;
  return static_cast<uint32_t>(std::lround(double(share_steps) * double(part) / double(total)));
}

// The 30 bits of one lobe; `left` is what earlier lobes left over, so that rounding never takes more than
// all.
uint32_t pack_share(const glm::vec3& part, const glm::vec3& total, glm::uvec3& left) {
  uint32_t bits = 0;
  for (int k = 0; k < 3; ++k) {
    const uint32_t share = std::min(steps(part[k], total[k]), left[k]);
    left[k] -= share;
    bits |= share << (10 * k);
  }
  return bits;
}

// Directional albedo, for o, of a lobe whose weight is 1. The lobe is |axis|^n times a power cosine about its
// axis, so that its integral is the mean of the cosine to n over that distribution.
double unit_lobe_albedo(const glm::dvec3& axis, double n) {
  constexpr int rings = 64, sectors = 32;
  const double length = glm::length(axis);
  const glm::dvec3 z = axis / length;
  const double sine_axis = std::sqrt(std::max(0.0, 1.0 - z.z * z.z));
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double log_cosine = std::log((i + 0.5) / rings) / (n + 1.0);
    const double cosine = std::exp(log_cosine), sine = std::sqrt(-std::expm1(2.0 * log_cosine));
    for (int j = 0; j < sectors; ++j)
      sum += std::max(0.0,
                      z.z * cosine + sine_axis * sine * std::cos(glm::radians(360.0 * (j + 0.5) / sectors)));
  }
  return (n + 2.0) / (n + 1.0) * std::pow(length, n) * sum / (rings * sectors);
}

// Largest albedo over all o of a lobe of weight 1: over the two vertical planes u and v, where |axis| is
// extreme.
float largest_lobe_albedo(const glm::vec2& ratios, float exponent) {
  // No axis is longer than 1: as for Phong, the horizon and the shorter axis only take away.
  if (std::abs(ratios.x) <= 1.0f && std::abs(ratios.y) <= 1.0f) return 1.0f;
  double largest = 1.0;
  for (int plane = 0; plane < 2; ++plane)
    for (int step = 1; step <= 256; ++step) {
      const double angle = glm::radians(90.0 * (step - 0.5) / 256.0);
      glm::dvec3 axis(0.0, 0.0, std::cos(angle));
      axis[plane] = double(ratios[plane]) * std::sin(angle);
      largest = std::max(largest, unit_lobe_albedo(axis, double(exponent)));
    }
  return static_cast<float>(largest);
}

shader::BrdfParams params(const GlossyPart& part) {
  return {glm::vec3(0.0f), part.exponent, part.glossy, part.shape};
}

glm::vec2 lobe_ratios(const shader::BrdfShape& shape, int lobe) {
  return glm::unpackHalf2x16(lobe == 0 ? shape.ratios_0 : lobe == 1 ? shape.ratios_1 : shape.ratios_2);
}

}  // namespace

bool GlossyPart::anisotropic() const {
  const auto differs = [](uint32_t ratios) { return (ratios & 0xffffu) != ratios >> 16; };
  if (model() == BrdfModel::phong) return false;
  if (model() == BrdfModel::lafortune)
    return differs(shape.ratios_0) || differs(shape.ratios_1) || differs(shape.ratios_2);
  return exponent != shape.exponent_v;
}

GlossyPart phong_part(const glm::vec3& albedo, float exponent) {
  return {albedo, exponent, shape_of(BrdfModel::phong)};
}

GlossyPart ashikhmin_shirley_part(const glm::vec3& f0, float exponent_u, float exponent_v) {
  GlossyPart part{f0, exponent_u, shape_of(BrdfModel::ashikhmin_shirley)};
  part.shape.exponent_v = exponent_v;
  return part;
}

GlossyPart ggx_part(const glm::vec3& f0, float alpha_u, float alpha_v) {
  GlossyPart part{f0, std::clamp(alpha_u, smallest_alpha, 1.0f), shape_of(BrdfModel::ggx)};
  part.shape.exponent_v = std::clamp(alpha_v, smallest_alpha, 1.0f);
  return part;
}

GlossyPart lafortune_part(std::span<const LafortuneLobe> lobes) {
  if (lobes.empty() || lobes.size() > 3)
    throw std::invalid_argument(fmt::format("Lafortune model: {} lobes; valid: 1 to 3", lobes.size()));
  GlossyPart part{glm::vec3(0.0f), 1.0f, shape_of(BrdfModel::lafortune)};
  shader::BrdfShape& shape = part.shape;
  uint32_t* ratios[3] = {&shape.ratios_0, &shape.ratios_1, &shape.ratios_2};
  float* exponents[3] = {&part.exponent, &shape.exponent_v, &shape.exponent_w};
  for (size_t i = 0; i < lobes.size(); ++i) {
    require_valid(lobes[i]);
    *ratios[i] = glm::packHalf2x16(glm::vec2(lobes[i].cx, lobes[i].cy) / lobes[i].cz);
    *exponents[i] = lobes[i].exponent;
    part.glossy += lobes[i].albedo;
  }
  glm::uvec3 left(share_steps);
  // What is left over by rounding must not go to a lobe that is not there.
  const glm::vec3 first = lobes.size() == 1 ? part.glossy : lobes[0].albedo;
  shape.shares_0_model |= pack_share(first, part.glossy, left);
  if (lobes.size() >= 2)
    shape.shares_1 = pack_share(lobes.size() == 2 ? part.glossy : lobes[1].albedo, part.glossy, left);
  return part;
}

glm::vec3 largest_albedo(const GlossyPart& part) {
  if (part.model() != BrdfModel::lafortune) return part.glossy;
  const shader::BrdfParams brdf = params(part);
  glm::vec3 sum(0.0f);
  for (int lobe = 0; lobe < shader::lafortune_lobes; ++lobe)
    if (const glm::vec3 weight = shader::lafortune_weight(brdf, lobe); weight != glm::vec3(0.0f))
      sum +=
          weight * largest_lobe_albedo(lobe_ratios(part.shape, lobe), shader::lafortune_exponent(brdf, lobe));
  return sum;
}

}  // namespace relight
