#include "common/shading/light_cache.h"

#include <algorithm>
#include <tuple>

namespace relight {
namespace {

auto values(const Light& l) {
  return std::tie(l.type, l.position, l.direction, l.edge_u, l.edge_v, l.radius, l.intensity, l.inner_degrees,
                  l.outer_degrees, l.casts_shadows, l.right, l.beam, l.sky, l.parameters);
}

// Takes one light equal to `light` out of `from`; false if there is none. Equal lights are counted.
bool take(std::vector<Light>& from, const Light& light) {
  const auto found =
      std::find_if(from.begin(), from.end(), [&](const Light& other) { return same_light(other, light); });
  if (found == from.end()) return false;
  from.erase(found);
  return true;
}

std::vector<Light> lit(const LightingState& lighting) {
  std::vector<Light> lights;
  for (const Light& light : lighting.lights)
    if (light.intensity != glm::vec3(0.0f)) lights.push_back(light);
  return lights;
}

}  // namespace

bool same_light(const Light& a, const Light& b) {
  const auto hash = [](const auto& content) { return content ? content->content_hash : 0; };
  return values(a) == values(b) && hash(a.slide) == hash(b.slide) &&
         hash(a.user_shader) == hash(b.user_shader);
}

LightCache::Plan LightCache::plan(const LightingState& lighting) {
  const std::vector<Light> lights = lit(lighting);
  std::vector<Light> fresh = lights;  // those not in the sum
  const bool keep = !sum_.empty() && std::all_of(sum_.begin(), sum_.end(),
                                                 [&](const Light& light) { return take(fresh, light); });
  if (!keep) sum_.clear(), fresh = lights;
  Plan plan;
  plan.from_zero = !keep;
  plan.cached = static_cast<int64_t>(sum_.size());
  std::vector<Light> before = previous_;
  for (const Light& light : sum_) take(before, light);
  for (const Light& light : fresh) (take(before, light) ? plan.into_sum : plan.on_top).push_back(light);
  pending_sum_ = std::move(sum_);
  pending_sum_.insert(pending_sum_.end(), plan.into_sum.begin(), plan.into_sum.end());
  pending_previous_ = lights;
  forget();
  return plan;
}

void LightCache::done() {
  sum_ = std::move(pending_sum_);
  previous_ = std::move(pending_previous_);
}

}  // namespace relight
