// Glossy final-gather rows of a view, for hard cases and tests.
#pragma once

#include "methods/direct_to_indirect/glossy_rays.h"
#include "methods/direct_to_indirect/hard_cases/gather_setup.h"

namespace relight::direct_to_indirect {

// Gives every view sample the glossy part, but every `every`-th none.
inline void make_glossy(DeepFrameBuffer& buffer, const GlossyPart& part, size_t every) {
  for (size_t i = 0; i < buffer.indirect.size(); ++i) {
    SurfaceSample& s = buffer.indirect[i];
    s.glossy = i % every == 0 ? glm::vec3(0.0f) : part.glossy;
    s.exponent = part.exponent, s.shape = part.shape;
  }
}

struct GlossyRun {
  FinalGather matrix;
  StageLog log;
};

inline GlossyRun gather_glossy(const GatherSetup& s, const FinalGatherSettings& settings,
                               const GlossyRays* rays = nullptr, const std::vector<float>& scale = {}) {
  GlossyRun run;
  Progress quiet(true);
  const GlossyGather glossy{s.buffer.view.camera.eye, rays};
  const TrainingLights none;
  run.matrix = compute_final_gather({s.tracer, s.buffer, s.cloud, s.hierarchy, scale, none, nullptr, &glossy},
                                    settings, quiet, run.log);
  return run;
}

}  // namespace relight::direct_to_indirect
