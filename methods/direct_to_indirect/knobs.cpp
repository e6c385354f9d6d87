#include "methods/direct_to_indirect/knobs.h"

namespace relight::direct_to_indirect {

KnobTable knob_table() {
  using enum KnobType;
  using enum KnobPhase;
  // clang-format off
  return {
      {"gather_samples", integer, precompute, "65536", 1024, 1048576, {}, "gather_cloud",
       "Number of gather samples; a power of four (paper: 65,536)."},
      {"light_points", choice, precompute, "1", 0, 0, {"1", "4"}, "gather_cloud",
       "Points of each gather sample on which direct light is computed and averaged: the sample itself (paper), or four of its cell (light_points.h)."},
      {"cloud", choice, precompute, "importance", 0, 0, {"uniform", "importance"}, "gather_cloud",
       "Gather samples spread evenly over the surfaces that the view can gather from, or by importance (paper: large scenes)."},
      {"hierarchy_k", real, precompute, "20", 0, 1000, {}, "hierarchy",
       "Weight K of positions against normals in the split distance of equation 9 (paper: 20 to 40; GPU Gems: 20)."},
      {"link_threshold", real, precompute, "0.02", 0, 100, {}, "final_gather",
       "A cluster is subdivided while (bounding-box diagonal / distance)^2 exceeds this; 0 links every sample (0.02: some 4,000 rays a view sample, as in the paper)."},
      {"link_members", choice, precompute, "one", 0, 0, {"one", "all"}, "final_gather",
       "A link to a cluster takes the element of one random member (paper), or the mean over all of them, each with its own visibility (as many rays as linking every sample)."},
      {"form_factor_clamp", real, precompute, "0.1", 0, 1, {}, "final_gather",
       "Largest value of a final-gather element, against 1/r^2 in corners (paper: 0.1)."},
      {"near_field", choice, precompute, "clamp", 0, 0, {"clamp", "disc", "cell_average", "hemisphere"}, "near_field",
       "Elements between close points: clamped (paper), bounded as discs, averaged over 8 points of the cell, or cosine rays snapped to gather samples (near_field.h)."},
      {"near_threshold", real, precompute, "0.01", 0.0001, 1, {}, "near_field",
       "With cell_average and hemisphere: share of the hemisphere that a gather sample's cell must fill to be near."},
      {"near_rays", integer, precompute, "256", 1, 65536, {}, "near_field",
       "With hemisphere: rays of a view sample that has anything near."},
      {"column_scaling", choice, precompute, "none", 0, 0, {"none", "mean_row"}, "column_scaling",
       "Columns as they are (paper), or divided by the mean row of the view, which flattens the rows (see column_scaling.h)."},
      {"coefficients", integer, precompute, "100", 0, 65536, {}, "truncation",
       "Wavelet coefficients kept a row of the final-gather matrix (paper: 100); 0: all of them, in dense rows for few pixels."},
      {"glossy", choice, precompute, "auto", 0, 0, {"off", "auto"}, "final_gather",
       "Glossy final-gather matrix: auto computes it where any visible surface is glossy; off leaves glossy reflection of indirect light out."},
      {"glossy_gather", choice, precompute, "links", 0, 0, {"links", "rays"}, "final_gather",
       "Elements of the glossy matrix: the lobe's value at linked gather samples (paper), or rays that follow the lobe, snapped to gather samples (glossy_rays.h)."},
      {"glossy_rays", integer, precompute, "256", 1, 65536, {}, "final_gather",
       "With glossy_gather=rays: rays of each glossy view sample."},
      {"glossy_coefficients", integer, precompute, "100", 0, 65536, {}, "truncation",
       "Wavelet coefficients kept a row of the glossy final-gather matrix (the paper names one number for both matrices: 100); 0: all."},
      {"energy_fraction", real, precompute, "1", 0, 1, {}, "truncation",
       "A row keeps no more coefficients than hold this share of its sum of squares; 1: as many as `coefficients` allows (paper)."},
      {"row_budget", choice, precompute, "fixed", 0, 0, {"fixed", "shared"}, "truncation",
       "Every row keeps the same number (paper), or rows share the budget: the heaviest coefficients of the view are kept."},
      {"view_basis", choice, precompute, "pixels", 0, 0, {"pixels", "haar"}, "truncation",
       "A row belongs to a view sample (paper), or to a Haar wavelet over 4x4 of them, which share their coefficients: as many in all, but what neighbours have in common is stored once (view_basis.h)."},
      {"support_exponent", real, precompute, "1", 0, 1, {}, "truncation",
       "A row keeps the coefficients with the largest |c| x support^this: 1 weights by area (paper), 0 by size alone."},
      {"bounces", integer, precompute, "1", 0, 64, {}, "multi_bounce",
       "Bounces of indirect light in all; 1: the final gather alone, nothing of the multiple-bounce matrix is computed (paper: 4, by photon paths of length 3); 0: direct light alone, nothing is precomputed."},
      {"multi_bounce", choice, precompute, "photons", 0, 0, {"photons", "transfer"}, "multi_bounce",
       "Multiple-bounce matrix by density estimation on photons (paper), or by links between gather samples, applied once a bounce."},
      {"bounce_coefficients", integer, precompute, "40", 0, 65536, {}, "multi_bounce",
       "Wavelet coefficients kept a row of the multiple-bounce matrix (paper: 40); 0: all of them."},
      {"photons", integer, precompute, "1000000", 1, 1000000000, {}, "multi_bounce",
       "Photon paths shot from the gather samples, spread evenly over them (paper: one million, about 15 a sample)."},
      {"photon_neighbours", integer, precompute, "2000", 2, 1000000, {}, "multi_bounce",
       "Nearest photons of the density estimate at a gather sample (paper: 2,000; GPU Gems: about 1,000)."},
      {"refit_lights", integer, precompute, "0", 0, 4096, {}, "refit",
       "Kept coefficients are refitted to this many random lights in front of the view; 0 leaves them as they are (paper)."},
      {"refit_candidates", real, precompute, "1", 1, 8, {}, "refit",
       "Of this many times the coefficients kept, the refit chooses those that serve its lights best; 1: no choice."},
      {"refit_ridge", real, precompute, "0.1", 0.001, 1000, {}, "refit",
       "Weight of the original values in the refit, in units of each coefficient's own squared response: how much its lights are distrusted."},
      {"upsampling", choice, precompute, "closest", 0, 0, {"closest", "none"}, "final_gather",
       "Indirect light is computed once a pixel and each of its 2x2 sub-pixels takes the closest pixel's (paper), or at every sub-pixel: four times the rows."},
      {"shadows", choice, relight, "auto", 0, 0, {"auto", "map", "traced"}, "direct_shading",
       "Shadows on view and gather samples: shadow maps (paper; GPU only) or exact traced rays; auto: traced if device=cpu, else map."},
      {"area_light_samples", integer, relight, "16", 1, 4096, {}, "direct_shading",
       "Points that stand for a rectangle or disc, each with shadows of its own."},
      {"shadow_map_size", integer, relight, "2048", 16, 8192, {}, "shadow_maps",
       "Texels a side of a shadow map."},
      {"device", choice, relight, "gpu", 0, 0, {"gpu", "cpu", "oracle"}, "transfer",
       "Where relighting runs: in GLSL, or all on the CPU in float; oracle: as gpu, but Haar transform and product in double on the CPU (slow)."},
      {"product", choice, relight, "tiles", 0, 0, {"rows", "tiles", "quads"}, "transfer",
       "Form of the sparse product: by rows, blocks of screen tiles summed in registers, or blended rectangles of columns (paper; GPU only)."},
      {"weights", choice, relight, "8", 0, 0, {"8", "16", "float32"}, "transfer",
       "How the product stores the matrix: integers of 8 (paper) or 16 bits with a scale a block or row, or floats."},
      {"cull_epsilon", real, relight, "0", -1, 1, {}, "transfer",
       "Blocks whose |wavelet light| x norm is at most this share of all lights' root sum of squares are skipped; below 0 none is (not by rows, not on the CPU)."},
      {"partial_results", choice, relight, "float32", 0, 0, {"float32", "float16"}, "transfer",
       "What product=quads blends in; the paper's 16 bits lose light (docs/products.md)."},
      {"block_waste", real, relight, "0.65", 0, 1, {}, "upload",
       "Largest share of zeros in a rectangle of product=quads before it is split (0.65: half of what is stored, as in the paper)."},
  };
  // clang-format on
}

std::vector<KnobPreset> knob_presets() {
  return {{"best",
           "The paper's number of coefficients, shared by the 4x4 rows of a tile (view_basis.h) and refitted to "
           "random lights (light_refit.h); direct light averaged over four points of a gather sample's cell "
           "(light_points.h); rays instead of the clamp between close points (near_field.h) and along glossy "
           "lobes (glossy_rays.h); 16-bit weights by rows, which such a basis suits.",
           {{"light_points", "4"},
            {"view_basis", "haar"},
            {"support_exponent", "0.6"},
            {"refit_lights", "512"},
            {"near_field", "hemisphere"},
            {"glossy_gather", "rays"},
            {"product", "rows"},
            {"weights", "16"}}}};
}

}  // namespace relight::direct_to_indirect
