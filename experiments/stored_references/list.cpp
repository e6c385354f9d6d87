#include "experiments/stored_references/list.h"

#include "experiments/options/parse.h"
#include "experiments/usage_error.h"

namespace relight {

namespace {

// Everything the path tracer can do in a scene without environment: six bounces carry more than 99 % of the
// light in scenes of these albedos.
LightPaths full_solution() {
  LightPaths paths;
  paths.min_bounces = 1, paths.max_bounces = 6;
  paths.glossy_at_eye = paths.glossy_interior = true;
  paths.environment = paths.emission = true;
  return paths;
}

// What direct-to-indirect transfer carries.
LightPaths one_diffuse_bounce() { return {}; }

// Temple's full detail (2.1 M triangles) takes longer to build than to render at this size.
constexpr const char* small_temple = "temple:detail=0.3";

}  // namespace

const std::vector<StoredReference>& stored_references() {
  static const std::vector<StoredReference> list = {
      {"cornell_spot", "cornell", "spot", full_solution(), 96},
      {"cornell_omni", "cornell", "omni", full_solution(), 96},
      {"cornell_near", "cornell", "near", full_solution(), 96},
      {"cornell_spot_one_bounce", "cornell", "spot", one_diffuse_bounce(), 16},
      {"colonnade_spot", "colonnade", "spot", full_solution(), 96},
      {"colonnade_spot2", "colonnade", "spot2", full_solution(), 96},
      {"colonnade_omni", "colonnade", "omni", full_solution(), 96},
      {"still_life_spot", "still_life", "spot", full_solution(), 48},
      {"still_life_omni", "still_life", "omni", full_solution(), 48},
      {"still_life_two", "still_life", "two", full_solution(), 48},
      {"hair_ball_spot", "hair_ball", "spot", full_solution(), 40},
      {"hair_ball_omni", "hair_ball", "omni", full_solution(), 40},
      {"temple_spot", small_temple, "spot", full_solution(), 128},
      {"temple_omni", small_temple, "omni", full_solution(), 128},
  };
  return list;
}

const StoredReference& stored_reference(const std::string& name) {
  std::string valid;
  for (const StoredReference& reference : stored_references()) {
    if (reference.name == name) return reference;
    append_name(valid, reference.name);
  }
  usage_fail("stored reference '{}': valid: {}", name, valid);
}

}  // namespace relight
