#include "methods/clustered_gather/view_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "common/image/luminance.h"
#include "methods/clustered_gather/nearest6.h"
#include "methods/clustered_gather/representative.h"

namespace relight::clustered_gather {
namespace {

constexpr float least_normal_cosine = 0.7071f;  // of 45 degrees

// Drops the links that would carry light around an edge, or from material to material; never all of them.
void drop_leaks(const SurfaceSample& pixel, Part part, const ViewClusters& clusters,
                std::vector<Neighbour6>& found) {
  const auto leaks = [&](const Neighbour6& n) {
    const SurfaceSample& cluster = clusters.samples[n.index];
    return glm::dot(pixel.shading_normal, cluster.shading_normal) < least_normal_cosine ||
           (part == Part::glossy && cluster.material != pixel.material);
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

std::vector<uint32_t> pixels_with(const DeepFrameBuffer& buffer, Part part) {
  std::vector<uint32_t> pixels;
  for (uint32_t p = 0; p < buffer.indirect.size(); ++p) {
    const SurfaceSample& s = buffer.indirect[p];
    if (s.valid && (part == Part::diffuse || s.glossy.x + s.glossy.y + s.glossy.z > 0.0f))
      pixels.push_back(p);
  }
  return pixels;
}

Split split_by_energy(const DeepFrameBuffer& buffer, size_t clusters) {
  double diffuse = 0.0, glossy = 0.0;
  for (const SurfaceSample& s : buffer.indirect) {
    if (!s.valid) continue;
    diffuse += static_cast<double>(luminance(s.diffuse));
    glossy += static_cast<double>(luminance(s.glossy));
  }
  if (clusters == 0 || !(glossy > 0.0)) return {clusters, 0};
  const auto share = static_cast<size_t>(static_cast<double>(clusters) * glossy / (diffuse + glossy));
  const size_t of_glossy = std::clamp<size_t>(share, 1, std::max<size_t>(clusters - 1, 1));
  return {std::max<size_t>(clusters - of_glossy, 1), of_glossy};
}

ViewClusters cluster_view(const DeepFrameBuffer& buffer, std::span<const uint32_t> pixels,
                          const Metric6& metric, const ClusteringSettings& settings) {
  std::vector<SurfaceSample> samples;
  std::vector<Point6> points;
  for (const uint32_t p : pixels) {
    samples.push_back(buffer.indirect[p]);
    points.push_back(metric(samples.back().position, samples.back().shading_normal));
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

Links link_pixels(const DeepFrameBuffer& buffer, std::vector<uint32_t> pixels, Part part,
                  const ViewClusters& clusters, const Metric6& metric, int neighbours) {
  Links links;
  if (clusters.centres.empty()) return links;
  links.per_pixel = static_cast<uint32_t>(neighbours);
  links.pixel = std::move(pixels);
  const size_t n = links.per_pixel;
  links.cluster.assign(links.pixel.size() * n, 0u);
  links.weight.assign(links.pixel.size() * n, 0.0f);
  const Nearest6 nearest(clusters.centres);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, links.pixel.size(), 256), [&](const auto& range) {
    std::vector<Neighbour6> found;
    for (size_t i = range.begin(); i < range.end(); ++i) {
      const SurfaceSample& s = buffer.indirect[links.pixel[i]];
      nearest.find(metric(s.position, s.shading_normal), n, found);
      drop_leaks(s, part, clusters, found);
      for (size_t k = 0; k < found.size(); ++k) links.cluster[i * n + k] = found[k].index;
      write_weights(found, links.weight.data() + i * n);
    }
  });
  return links;
}

}  // namespace relight::clustered_gather
