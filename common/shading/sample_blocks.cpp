#include "common/shading/sample_blocks.h"

#include <algorithm>
#include <numeric>

namespace relight {
namespace {

constexpr uint32_t no_sample = SampleBlocks::no_sample;

bool is_glossy(const SurfaceSample& s) { return s.valid && s.glossy != glm::vec3(0.0f); }

void put(float (&lanes)[3][block_lanes], size_t lane, const glm::vec3& v) {
  for (size_t c = 0; c < 3; ++c) lanes[c][lane] = v[static_cast<int>(c)];
}

}  // namespace

SampleBlocks::SampleBlocks(const std::vector<SurfaceSample>& samples, std::span<const uint32_t> order,
                           const glm::vec3& eye)
    : eye_(eye), order_(order.begin(), order.end()) {
  const size_t blocks = (order.size() + block_lanes - 1) / block_lanes;
  order_.resize(blocks * block_lanes, no_sample);
  geometry_.resize(blocks);  // zero: no light
  diffuse_.resize(blocks);
  bounds_.resize(blocks);
  glossy_of_.resize(blocks, not_glossy);
  for (size_t b = 0; b < blocks; ++b) {
    bool any_glossy = false;
    for (size_t lane = 0; lane < block_lanes; ++lane) {
      const uint32_t i = sample_index(b, lane);
      if (i == no_sample || !samples[i].valid) continue;
      add(samples[i], b, lane);
      any_glossy = any_glossy || is_glossy(samples[i]);
    }
    if (any_glossy) add_glossy(samples, b);
  }
}

void SampleBlocks::add(const SurfaceSample& sample, size_t block, size_t lane) {
  put(geometry_[block].position, lane, sample.position);
  put(geometry_[block].shading_normal, lane, sample.shading_normal);
  put(geometry_[block].geometric_normal, lane, sample.geometric_normal);
  put(diffuse_[block].rgb, lane, sample.diffuse);
  bounds_[block].add(sample.position, sample.geometric_normal);
}

void SampleBlocks::add_glossy(const std::vector<SurfaceSample>& samples, size_t block) {
  glossy_of_[block] = static_cast<uint32_t>(glossy_.size());
  for (size_t lane = 0; lane < block_lanes; ++lane) {
    const uint32_t i = sample_index(block, lane);
    glossy_.push_back(i == no_sample ? SurfaceSample{}.brdf() : samples[i].brdf());
  }
}

int64_t SampleBlocks::bytes() const {
  const auto of = [](const auto& v) { return static_cast<int64_t>(v.size() * sizeof(v[0])); };
  return of(order_) + of(geometry_) + of(bounds_) + of(diffuse_) + of(glossy_of_) + of(glossy_);
}

std::vector<uint32_t> sequential_order(size_t samples) {
  std::vector<uint32_t> order(samples);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

std::vector<uint32_t> pixel_quad_order(int width, int height) {
  std::vector<uint32_t> order;
  for (int top = 0; top < height; top += 2) {
    for (int left = 0; left < width; left += 2) {
      for (int lane = 0; lane < static_cast<int>(block_lanes); ++lane) {
        const int pixel = lane / 4, sub = lane % 4;
        const int px = left + pixel % 2, py = top + pixel / 2;
        const int x = 2 * px + sub % 2, y = 2 * py + sub / 2;
        const bool inside = px < width && py < height;
        order.push_back(inside ? static_cast<uint32_t>(y * 2 * width + x) : no_sample);
      }
    }
  }
  return order;
}

}  // namespace relight
