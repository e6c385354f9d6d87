// Views whose samples see nothing, or lie on geometry thinner than a cluster.
#include <algorithm>
#include <cmath>

#include "common/hard_cases/image_difference.h"
#include "common/hard_cases/method_bench.h"
#include "common/hard_cases/tiny_scenes.h"
#include "common/scene/scene_file.h"
#include "methods/clustered_gather/clustered_gather.h"
#include "methods/clustered_gather/hard_cases/hard_cases.h"
#include "methods/clustered_gather/view_clusters.h"

namespace relight::clustered_gather {

namespace {

using namespace hard;

// A floor under an empty sky, seen from above.
Figures view_that_sees_nothing() {
  Scene scene = tiny::empty_scene();
  tiny::add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  scene.camera.eye = {0.0f, 2.0f, 0.1f};
  scene.camera.target = glm::vec3(0.0f);
  finish_scene(scene);
  MethodBench bench(make_clustered_gather(), std::move(scene),
                    {{"view_clusters", "50"}, {"directions", "100"}, {"gather_clusters", "16"}}, 24, 18);
  Figures figures;
  for (const char* device : {"cpu", "gpu", "oracle"}) {
    const Relit relit = bench.relight({{"device", device}}, tiny::lighting({tiny::omni({0.3f, 1.0f, 0.2f})}));
    add_worst(figures, non_finite_pixels({&relit.total}));
    add_worst(figures, at_most("indirect light", norm(relit.indirect), 0.0, "all rays miss"));
    add_worst(figures, at_least("direct light", norm(relit.direct), 1e-9, "else the view is black anyway"));
  }
  return figures;
}

struct LinkCheck {
  double sum_error = 0.0, least = 0.0, leaks = 0.0;
};

// Weights of every pixel, and links to clusters that face elsewhere beside one that doesn't.
LinkCheck check_links(const DeepFrameBuffer& buffer, const ViewClusters& clusters, const Links& links) {
  LinkCheck check;
  for (size_t i = 0; i < links.pixel.size(); ++i) {
    double sum = 0.0, astray = 0.0, same = 0.0;
    for (size_t k = links.per_pixel * i; k < links.per_pixel * (i + 1); ++k) {
      const auto w = static_cast<double>(links.weight[k]);
      sum += w, check.least = std::min(check.least, w);
      const float cosine = glm::dot(buffer.indirect[links.pixel[i]].shading_normal,
                                    clusters.samples[links.cluster[k]].shading_normal);
      (cosine > 0.7f ? same : astray) += w;
    }
    check.sum_error = std::max(check.sum_error, std::abs(sum - 1.0));
    check.leaks += same > 0.0 && astray > 0.0;
  }
  return check;
}

// A ball of 150 tubes, most of them narrower than a pixel: members of a view cluster lie on several.
Figures thin_geometry() {
  MethodBench bench(make_clustered_gather(), load_scene("hair_ball:strands=150,segments=6,sides=3"),
                    {{"device", "cpu"}, {"directions", "100"}, {"gather_clusters", "16"}}, 48, 36);
  ClusteringSettings settings;
  settings.clusters = 300;
  const Metric6 metric(bench.scene.bounds.diagonal(), 1.0f);
  const std::vector<uint32_t> pixels = pixels_with(bench.buffer, Part::diffuse);
  const ViewClusters clusters = cluster_view(bench.buffer, pixels, metric, settings);
  const LinkCheck links = check_links(bench.buffer, clusters,
                                      link_pixels(bench.buffer, pixels, Part::diffuse, clusters, metric, 10));
  const LightingState lighting = load_lighting(bench.scene, "omni");
  const Relit few = bench.relight({{"view_clusters", "300"}}, lighting),
              all = bench.relight({{"view_clusters", "0"}, {"neighbours", "1"}}, lighting);
  return {non_finite_pixels({&few.total, &all.total}),
          at_most("sum of a pixel's weights off 1", links.sum_error, 1e-5, "rounding of ten weights"),
          at_least("least weight", links.least, 0.0, "light is not subtracted"),
          at_most("pixels that take light around an edge", links.leaks, 0.0,
                  "clusters that face elsewhere are left out where there are others"),
          at_least("share of pixels on a geometric edge", bench.buffer.edge_share(), 0.1,
                   "else the geometry is not thin"),
          at_most("indirect light, 300 view clusters against every pixel",
                  relative_difference(few.indirect, all.indirect), 0.3,
                  "stated, about twice what was measured: five pixels a cluster on tubes narrower than one")};
}

}  // namespace

Cases view_cases() {
  return {{"a view sample that sees nothing", "Clusters of no gather points; division by their number.",
           view_that_sees_nothing},
          {"view clusters on thin geometry",
           "Clusters span tubes that face anywhere; light leaks around them.", thin_geometry}};
}

}  // namespace relight::clustered_gather
