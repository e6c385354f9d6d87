#include "methods/clustered_gather/view_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "methods/clustered_gather/nearest6.h"
#include "methods/clustered_gather/representative.h"

namespace relight::clustered_gather {
namespace {

constexpr float least_normal_cosine = 0.7071f;  // of 45 degrees

// Drops the links that would carry light around an edge; never all of them.
void drop_leaks(const SurfaceSample& pixel, const ViewClusters& clusters, std::vector<Neighbour6>& found) {
  const auto leaks = [&](const Neighbour6& n) {
    return glm::dot(pixel.shading_normal, clusters.samples[n.index].shading_normal) < least_normal_cosine;
  };
  if (std::all_of(found.begin(), found.end(), leaks))
    found.resize(1);
  else
    std::erase_if(found, leaks);
}

// Radial basis weights that sum to 1.
void write_weights(const std::vector<Neighbour6>& found, float* weight) {
  const float farthest = std::sqrt(found.back().distance2);
  // A little beyond the farthest, which would count for nothing; distances of zero give equal weights.
  const float radius = 1.1f * farthest + std::numeric_limits<float>::min();
  float sum = 0.0f;
  for (size_t k = 0; k < found.size(); ++k) {
    const float t = 1.0f - std::sqrt(found[k].distance2) / radius;
    weight[k] = t * t;
    sum += weight[k];
  }
  for (size_t k = 0; k < found.size(); ++k) weight[k] /= sum;
}

}  // namespace

ViewClusters cluster_view(const DeepFrameBuffer& buffer, const Metric6& metric,
                          const ClusteringSettings& settings) {
  std::vector<SurfaceSample> samples;
  std::vector<Point6> points;
  for (const SurfaceSample& s : buffer.indirect) {
    if (!s.valid) continue;
    samples.push_back(s);
    points.push_back(metric(s.position, s.shading_normal));
  }
  ClusteringSettings wanted = settings;
  if (wanted.clusters == 0) wanted.clusters = std::max<size_t>(points.size(), 1);
  const Clustering clustering = cluster_points(points, wanted);
  const Members members = members_of(clustering.cluster_of, clustering.centres.size());
  ViewClusters out;
  out.centres = clustering.centres;
  out.samples.resize(out.centres.size());
  tbb::parallel_for(size_t{0}, out.centres.size(),
                    [&](size_t k) { out.samples[k] = representative(samples, members.of(k)); });
  return out;
}

Links link_pixels(const DeepFrameBuffer& buffer, const ViewClusters& clusters, const Metric6& metric,
                  int neighbours) {
  Links links;
  if (clusters.centres.empty()) return links;
  links.per_pixel = static_cast<uint32_t>(neighbours);
  const size_t pixels = buffer.indirect.size(), n = links.per_pixel;
  links.cluster.assign(pixels * n, 0u);
  links.weight.assign(pixels * n, 0.0f);
  const Nearest6 nearest(clusters.centres);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, pixels, 256), [&](const auto& range) {
    std::vector<Neighbour6> found;
    for (size_t p = range.begin(); p < range.end(); ++p) {
      const SurfaceSample& s = buffer.indirect[p];
      if (!s.valid) continue;
      nearest.find(metric(s.position, s.shading_normal), n, found);
      drop_leaks(s, clusters, found);
      for (size_t k = 0; k < found.size(); ++k) links.cluster[p * n + k] = found[k].index;
      write_weights(found, links.weight.data() + p * n);
    }
  });
  return links;
}

}  // namespace relight::clustered_gather
