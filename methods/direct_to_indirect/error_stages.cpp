#include "methods/direct_to_indirect/error_stages.h"

#include <fmt/format.h>

namespace relight::direct_to_indirect {
namespace {

// Rays of the twin of `close points` for each view sample, and the share of its hemisphere from which on a
// cell is close there: a disc that fills less is within 2 % of a point's form factor.
constexpr int twin_near_rays = 4096;
constexpr double twin_near_threshold = 0.002;

// What the twin of the multiple-bounce matrix may take.
constexpr int64_t bounce_bytes = int64_t{1} << 31;

bool on_gpu(const KnobValues& knobs) { return knobs.choice("device") != "cpu"; }

ErrorStage shadows(const KnobValues& knobs) {
  return {"shadows",
          "Shadow maps have texels and a bias; twin: a ray for each sample and light.",
          {{"shadows", "traced"}},
          on_gpu(knobs) && knobs.choice("shadows") != "traced"};
}

ErrorStage quantisation(const KnobValues& knobs) {
  const bool product = knobs.choice("device") != "oracle";
  const bool blended = knobs.choice("product") == "quads" && knobs.choice("partial_results") == "float16";
  return {"quantisation",
          fmt::format(
              "Weights are stored as {}; twin: 32-bit floats, blended in 32 bits.",
              knobs.choice("weights") == "float32" ? "floats" : knobs.choice("weights") + "-bit integers"),
          {{"weights", "float32"}, {"partial_results", "float32"}},
          product && (knobs.choice("weights") != "float32" || blended)};
}

ErrorStage culling(const KnobValues& knobs) {
  return {"culling",
          "Blocks that would add little under this light are skipped; twin: none is.",
          {{"cull_epsilon", "-1"}},
          knobs.real("cull_epsilon") > 0.0 && knobs.choice("device") == "gpu" &&
              knobs.choice("product") != "rows"};
}

ErrorStage upsampling(const KnobValues& knobs) {
  return {"upsampling",
          "Indirect light is computed once a pixel; twin: at each of the 2x2 sub-pixels that the reference "
          "samples too.",
          {{"upsampling", "none"}},
          knobs.choice("upsampling") != "none"};
}

ErrorStage truncation(const KnobValues& knobs) {
  const int64_t kept = knobs.integer("coefficients"), all = knobs.integer("gather_samples");
  const std::string ways =
      fmt::format("{}{}{}", knobs.integer("refit_lights") > 0 ? ", refitted to lights" : "",
                  knobs.choice("row_budget") == "shared" ? ", shared among rows" : "",
                  knobs.choice("column_scaling") != "none" ? ", columns scaled" : "");
  return {"truncation",
          fmt::format("A row keeps {} of {} wavelet coefficients{}; twin: all of them, as they are.",
                      kept == 0 ? all : kept, all, ways),
          {{"coefficients", "0"},
           {"glossy_coefficients", "0"},
           {"environment_coefficients", "0"},
           {"energy_fraction", "1"},
           {"row_budget", "fixed"},
           {"column_scaling", "none"},
           {"view_basis", "pixels"},
           {"refit_lights", "0"},
           {"refit_candidates", "1"}},
          (kept > 0 && kept < all) || knobs.real("energy_fraction") < 1.0};
}

ErrorStage close_points(const KnobValues& knobs) {
  const std::string& kind = knobs.choice("near_field");
  const std::string how =
      kind == "clamp" ? fmt::format("clamped to {}", knobs.real("form_factor_clamp"))
      : kind == "disc"
          ? "bounded as discs"
          : fmt::format("estimated by {} where a cell fills {} of the hemisphere",
                        kind == "cell_average" ? "8 points of the cell"
                                               : fmt::format("{} rays", knobs.integer("near_rays")),
                        knobs.real("near_threshold"));
  return {"close points",
          fmt::format("Elements between points close to each other are {}; twin: {} rays of the hemisphere, "
                      "snapped to cells, where a cell fills {} of it, and no clamp. Glossy elements: {} rays "
                      "of the lobe.",
                      how, twin_near_rays, twin_near_threshold, twin_near_rays),
          {{"near_field", "hemisphere"},
           {"near_rays", fmt::format("{}", twin_near_rays)},
           {"near_threshold", fmt::format("{}", twin_near_threshold)},
           {"form_factor_clamp", "1"},
           {"glossy_gather", "rays"},
           {"glossy_rays", fmt::format("{}", twin_near_rays)}},
          kind != "hemisphere" || knobs.integer("near_rays") < twin_near_rays ||
              knobs.real("near_threshold") > twin_near_threshold};
}

ErrorStage multi_bounce(const KnobValues& knobs) {
  const int64_t samples = knobs.integer("gather_samples");
  const bool all_fit = samples * samples * 8 <= bounce_bytes;
  const int64_t kept = all_fit ? 0 : bounce_bytes / (8 * samples);
  return {"multi-bounce",
          fmt::format("Light between gather samples comes from {}; twin: links between them, applied once a "
                      "bounce, with {} coefficients a row.",
                      knobs.choice("multi_bounce") == "photons" ? "a density estimate on photons"
                                                                : "truncated rows of links",
                      all_fit ? "all" : fmt::format("{} (2 GiB)", kept)),
          {{"multi_bounce", "transfer"}, {"bounce_coefficients", fmt::format("{}", kept)}},
          knobs.integer("bounces") > 1};
}

ErrorStage link_members(const KnobValues& knobs) {
  const std::string& members = knobs.choice("link_members");
  const std::string taken =
      fmt::format("{} random member{} of its cluster", members, members == "one" ? "" : "s");
  return {"link members",
          fmt::format("A link takes {}; twin: the mean over all members, each with its own visibility.",
                      knobs.choice("link_element") == "mean"
                          ? fmt::format("the mean element of its cluster and the visibility of {}", taken)
                          : fmt::format("the element of {}", taken)),
          {{"link_members", "all"}, {"link_element", "member"}},
          (members != "all" || knobs.choice("link_element") == "mean") && knobs.real("link_threshold") > 0.0};
}

ErrorStage links(const KnobValues& knobs) {
  return {
      "link clusters",
      fmt::format("Clusters of gather samples with (diagonal / distance)^2 below {} are linked as one; twin: "
                  "every sample is linked by itself.",
                  knobs.real("link_threshold")),
      {{"link_threshold", "0"}},
      knobs.real("link_threshold") > 0.0};
}

// More points and larger clouds, as far as the knob's range goes.
std::vector<ErrorStage> larger_clouds(const KnobValues& knobs) {
  std::vector<ErrorStage> out;
  if (knobs.choice("light_points") == "1")
    out.push_back({"4 points a gather sample",
                   "The same with direct light averaged over four points of each cell.",
                   {{"light_points", "4"}}});
  for (const int64_t factor : {4, 16}) {
    const int64_t samples = factor * knobs.integer("gather_samples");
    if (samples > 1048576) break;
    out.push_back({fmt::format("{} x gather samples", factor),
                   fmt::format("The same with {} gather samples.", samples),
                   {{"gather_samples", fmt::format("{}", samples)}}});
  }
  return out;
}

}  // namespace

ErrorStages error_stages(const KnobValues& knobs) {
  ErrorStages out;
  out.stages = {shadows(knobs),      quantisation(knobs), culling(knobs),
                upsampling(knobs),   truncation(knobs),   close_points(knobs),
                multi_bounce(knobs), link_members(knobs), links(knobs)};
  out.remainder = "gather cloud";
  out.remainder_sentence = fmt::format(
      "Direct light is known at {} gather samples, each of which stands for its cell{}; twin: the "
      "reference.",
      knobs.integer("gather_samples"), knobs.choice("light_points") == "1" ? "" : ", at four points of it");
  out.closer = larger_clouds(knobs);
  return out;
}

}  // namespace relight::direct_to_indirect
