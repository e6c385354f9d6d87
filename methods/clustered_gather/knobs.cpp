#include "methods/clustered_gather/knobs.h"

namespace relight::clustered_gather {

KnobTable knob_table() {
  using enum KnobType;
  using enum KnobPhase;
  // clang-format off
  return {
      {"directions", integer, precompute, "2000", 1, 1048576, {}, "gather_samples",
       "Quasi-Monte Carlo directions of a view cluster (paper: 2000).",
       tuned_by_factor(2, 64, 16384)},
      {"gather_clusters", integer, precompute, "120", 0, 1048576, {}, "direct_shading",
       "Clusters that the gather samples of a view cluster are reduced to (paper: 120); 0 keeps all.",
       tuned_by_factor(2, 8, 1024)},
      {"view_clusters", integer, precompute, "40000", 0, 16777216, {}, "direct_shading",
       "Clusters of view samples, at which indirect light is computed, diffuse and glossy ones together (paper: 40,000); 0: every pixel is one.",
       tuned_by_factor(2, 500, 640000)},
      {"neighbours", integer, precompute, "10", 1, 64, {}, "links",
       "View clusters that a pixel interpolates (paper: 10).",
       tuned_by_factor(1.6, 1, 32)},
      {"glossy", choice, precompute, "auto", 0, 0, {"auto", "off"}, "direct_shading",
       "View clusters of their own for glossy reflection, if the view has any (paper), or none."},
      {"bounces", integer, precompute, "1", 0, 1, {}, "direct_shading",
       "Bounces of indirect light: 1 (paper), or 0: direct light alone, nothing is clustered or gathered."},
      {"normal_weight", real, precompute, "1", 0, 100, {}, "clustering",
       "Opposite normals count as the scene's diagonal times this (paper: about 1)."},
      {"clustering", choice, precompute, "two_phase", 0, 0, {"two_phase", "kmeans"}, "clustering",
       "k-means from repeated splits of the worst cluster (paper), or from random points.",
       tuned_by_choice({"kmeans", "two_phase"})},
      {"iterations", integer, precompute, "5", 0, 1000, {}, "clustering",
       "Iterations of k-means at most (the paper does not say).",
       tuned_by_factor(2, 1, 20)},
      {"environment", choice, precompute, "auto", 0, 0, {"auto", "off", "on"}, "gather_samples",
       "Direct light from the environment: auto prepares for it where the scene or the lighting at hand has one; off leaves directions that hit nothing black (paper)."},
      {"environment_samples", integer, precompute, "4096", 256, 65536, {}, "environment",
       "Texels of the environment, the finest that its light is told apart by; a power of four."},
      {"device", choice, relight, "gpu", 0, 0, {"gpu", "cpu", "oracle"}, "indirect_sum",
       "Everything in GLSL; all on the CPU with traced shadows; or sums in double precision on the CPU after shading on the GPU.",
       tuned_by_choice({"cpu", "gpu"})},
      {"storage", choice, relight, "full", 0, 0, {"full", "half", "bytes"}, "direct_shading",
       "Gather samples as 32-bit floats (64 bytes), as 16-bit floats (20 bytes, as in the paper), or as integers (12 bytes); link weights as 32-bit or else 16-bit floats.",
       tuned_by_choice({"bytes", "half", "full"})},
      {"shadows", choice, relight, "auto", 0, 0, {"auto", "map", "traced"}, "shadow_maps",
       "Shadow maps or traced shadow rays; auto: maps on the GPU (paper), rays on the CPU."},
      {"area_light_samples", integer, relight, "16", 1, 4096, {}, "direct_shading",
       "Points that stand for a rectangle or disc, each with shadows of its own."},
      {"shadow_map_size", integer, relight, "2048", 64, 16384, {}, "shadow_maps",
       "Texels a side of a spot's shadow map and of each face of an omni's.",
       tuned_by_factor(2, 256, 8192).idle_while("device", {"cpu"})},
  };
  // clang-format on
}

}  // namespace relight::clustered_gather
