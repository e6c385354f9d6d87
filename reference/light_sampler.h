// The delta lights (omni, spot, directional) of a lighting state as a path tracer samples them: which light,
// and which direction from it.
#pragma once

#include <vector>

#include "common/lights/emitter.h"

namespace relight {

// A ray leaving a light. `directional_pdf` counts the choice of the light too [1/sr].
struct LightRay {
  size_t light = 0;
  glm::vec3 origin{0.0f}, direction{0.0f};
  float directional_pdf = 0.0f;  // 0: there is nothing to sample
};

class LightSampler {
 public:
  // scene_diagonal: makes directional lights comparable in power, and is how far away they are put.
  explicit LightSampler(const LightingState& lighting, float scene_diagonal = 1.0f);

  size_t size() const { return lights_.size(); }
  const Emitter& emitter(size_t light) const { return lights_[light].emitter; }
  // Where a shadow ray from `from` to the light ends: at the light, or far outside the scene.
  glm::vec3 shadow_ray_end(size_t light, const glm::vec3& from) const {
    const Emitter& e = lights_[light].emitter;
    return e.is_directional() ? from - e.axis() * (2.0f * scene_diagonal_) : e.position();
  }
  bool casts_shadows(size_t light) const { return lights_[light].emitter.casts_shadows; }

  // Next-event estimation goes to every light if there are few, else to one chosen by power with u in [0,1).
  bool all() const { return lights_.size() <= most_lights_for_all; }
  size_t choose(float u) const;
  // With which next-event estimation takes `light`: 1 if it takes all.
  float next_event_probability(size_t light) const { return all() ? 1.0f : lights_[light].probability; }

  // Emission: an omni light uniformly over the sphere, a spot uniformly over its outer cone. Lights without
  // shadows are left out, because light rays stop at the first surface and theirs don't; directional lights,
  // because they have no place to start from.
  bool emits() const { return !lights_.empty() && lights_.back().emission_cumulative > 0.0; }
  LightRay emit(float u_light, const glm::vec2& u) const;
  // The directional_pdf with which emit() leaves `light` in a direction where its intensity isn't zero.
  float emission_pdf(size_t light) const { return lights_[light].emission_pdf; }

 private:
  static constexpr size_t most_lights_for_all = 4;  // a shadow ray costs about as much as choosing well
  struct Entry {
    Emitter emitter;
    bool emits = false;
    double one_minus_cosine = 2.0;  // of the cone of directions; 2 for the sphere
    float probability = 0.0f;       // of choose()
    double cumulative = 0.0;        // upper end of its interval in choose()
    float emission_pdf = 0.0f;
    double emission_cumulative = 0.0;
  };
  std::vector<Entry> lights_;
  float scene_diagonal_;
};

}  // namespace relight
