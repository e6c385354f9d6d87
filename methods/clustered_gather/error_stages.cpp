#include "methods/clustered_gather/error_stages.h"

#include <fmt/format.h>

namespace relight::clustered_gather {
namespace {

ErrorStage shadows(const KnobValues& knobs) {
  return {"shadows",
          "Shadow maps have texels and a bias; twin: a ray for each sample and light.",
          {{"shadows", "traced"}},
          knobs.choice("device") != "cpu" && knobs.choice("shadows") != "traced"};
}

// With as many view clusters as pixels the nearest one is the pixel itself.
ErrorStage interpolation(const KnobValues& knobs) {
  return {
      "interpolation",
      fmt::format("A pixel interpolates between its {} nearest view clusters; twin: it takes the nearest.",
                  knobs.integer("neighbours")),
      {{"neighbours", "1"}},
      knobs.integer("neighbours") > 1};
}

ErrorStage view_clusters(const KnobValues& knobs) {
  return {"view clusters",
          fmt::format("Indirect light is computed at {} clusters of view samples; twin: at every pixel.",
                      knobs.integer("view_clusters")),
          {{"view_clusters", "0"}},
          knobs.integer("view_clusters") > 0};
}

ErrorStage storage(const KnobValues& knobs) {
  const std::string& format = knobs.choice("storage");
  return {"storage",
          fmt::format("Gather samples and link weights are kept as {}; twin: as 32-bit floats.",
                      format == "bytes" ? "integers of 8 and 16 bits" : "16-bit floats"),
          {{"storage", "full"}},
          format != "full"};
}

ErrorStage gather_clusters(const KnobValues& knobs) {
  return {
      "gather clusters",
      fmt::format("The points that {} directions hit are reduced to {} clusters; twin: all of them are lit.",
                  knobs.integer("directions"), knobs.integer("gather_clusters")),
      {{"gather_clusters", "0"}},
      knobs.integer("gather_clusters") > 0 && knobs.integer("gather_clusters") < knobs.integer("directions")};
}

}  // namespace

ErrorStages error_stages(const KnobValues& knobs) {
  ErrorStages out;
  // View clusters before interpolation: the nearest of few clusters alone would be another approximation, a
  // picture of facets.
  out.stages = {shadows(knobs), storage(knobs), view_clusters(knobs), interpolation(knobs),
                gather_clusters(knobs)};
  const int64_t directions = knobs.integer("directions");
  out.remainder = "directions";
  out.remainder_sentence = fmt::format(
      "Light comes from {} directions of a low-discrepancy sequence, once a pixel; twin: the reference.",
      directions);
  for (const int64_t factor : {4, 16})
    if (factor * directions <= 1048576)
      out.closer.push_back({fmt::format("{} x directions", factor),
                            fmt::format("The same with {} directions.", factor * directions),
                            {{"directions", fmt::format("{}", factor * directions)}}});
  return out;
}

}  // namespace relight::clustered_gather
