#include "common/shading/block_shading.h"

#include <limits>

namespace relight {
namespace {

glm::vec3 lane(const float (&v)[3][block_lanes], size_t i) { return {v[0][i], v[1][i], v[2][i]}; }

// Lane by lane: beams branch, call pow and read slides.
void shape_beam(const Emitter& light, const SampleBlock& block, BlockRgb& e) {
  for (size_t i = 0; i < block_lanes; ++i) {
    const glm::vec3 bare(e.rgb[0][i], e.rgb[1][i], e.rgb[2][i]);
    if (bare == glm::vec3(0.0f)) continue;
    const glm::vec3 shaped = bare * light.beam->factor(lane(block.position, i) - light.position());
    e.rgb[0][i] = shaped.x, e.rgb[1][i] = shaped.y, e.rgb[2][i] = shaped.z;
  }
}

void irradiance(const Emitter& light, const SampleBlock& block, BlockRgb& out) {
  const shader::LightParams params = light.params;  // a copy: nothing that the loop writes can be part of it
  for (size_t i = 0; i < block_lanes; ++i) {
    const glm::vec3 e = shader::light_irradiance(
        params, lane(block.position, i), lane(block.shading_normal, i), lane(block.geometric_normal, i));
    out.rgb[0][i] = e.x, out.rgb[1][i] = e.y, out.rgb[2][i] = e.z;
  }
  if (light.beam) shape_beam(light, block, out);
}

void reflect_diffuse(const BlockRgb& albedo, const BlockRgb& e, BlockRgb& out) {
  for (size_t c = 0; c < 3; ++c) {
    for (size_t i = 0; i < block_lanes; ++i) {
      shader::BrdfParams brdf{};
      brdf.diffuse.x = albedo.rgb[c][i];
      out.rgb[c][i] = shader::brdf_diffuse(brdf).x * e.rgb[c][i];
    }
  }
}

// Lane by lane: glossy models branch and call pow.
void reflect_all(const Emitter& light, const SampleBlocks& blocks, size_t block,
                 const shader::BrdfParams* brdf, LaneMask lanes, const BlockRgb& e, BlockRgb& out) {
  const SampleBlock& geometry = blocks.geometry(block);
  for (size_t i = 0; i < block_lanes; ++i) {
    if (!((lanes >> i) & 1u)) continue;
    const glm::vec3 position = lane(geometry.position, i);
    const glm::vec3 wo = glm::normalize(blocks.eye() - position);
    const glm::vec3 wi = light.direction_from(position);
    const glm::vec3 f = shader::brdf_eval(brdf[i], lane(geometry.shading_normal, i), wo, wi);
    for (size_t c = 0; c < 3; ++c) out.rgb[c][i] = f[static_cast<int>(c)] * e.rgb[c][i];
  }
}

// Blackens the other lanes.
void keep(LaneMask lanes, BlockRgb& value) {
  uint32_t all_bits[block_lanes];
  for (uint32_t i = 0; i < block_lanes; ++i) all_bits[i] = 0u - ((lanes >> i) & 1u);
  for (size_t c = 0; c < 3; ++c)
    for (size_t i = 0; i < block_lanes; ++i) value.rgb[c][i] = all_bits[i] != 0u ? value.rgb[c][i] : 0.0f;
}

LaneMask mask_of(const uint32_t (&flags)[block_lanes]) {
  LaneMask mask = 0;
  for (uint32_t i = 0; i < block_lanes; ++i) mask |= (flags[i] & 1u) << i;
  return mask;
}

LaneMask non_finite_lanes(const BlockRgb& value) {
  uint32_t flags[block_lanes] = {};
  for (size_t c = 0; c < 3; ++c)
    for (size_t i = 0; i < block_lanes; ++i)
      flags[i] |= std::abs(value.rgb[c][i]) <= std::numeric_limits<float>::max() ? 0u : 1u;
  return mask_of(flags);
}

}  // namespace

LaneMask lit_lanes(const Emitter& light, const SampleBlock& block) {
  BlockRgb e;
  irradiance(light, block, e);
  uint32_t flags[block_lanes] = {};
  for (size_t c = 0; c < 3; ++c)
    for (size_t i = 0; i < block_lanes; ++i) flags[i] |= e.rgb[c][i] != 0.0f ? 1u : 0u;
  return mask_of(flags);
}

LaneMask reflected(const Emitter& light, const SampleBlocks& blocks, size_t block, Lobes lobes,
                   LaneMask visible, BlockRgb& out) {
  BlockRgb e;
  irradiance(light, blocks.geometry(block), e);
  const shader::BrdfParams* glossy = lobes == Lobes::all ? blocks.glossy(block) : nullptr;
  if (glossy)
    reflect_all(light, blocks, block, glossy, visible, e, out);
  else
    reflect_diffuse(blocks.diffuse(block), e, out);
  keep(visible, out);
  const LaneMask bad = non_finite_lanes(out);
  if (bad != 0) keep(visible & ~bad, out);
  return bad;
}

}  // namespace relight
