#include "methods/direct_to_indirect/column_scaling.h"

#include <algorithm>
#include <numeric>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "common/wavelet/haar.h"
#include "methods/direct_to_indirect/tile_gather.h"
#include "methods/direct_to_indirect/view_tiles.h"

namespace relight::direct_to_indirect {
namespace {

// The share of the mean that every column keeps.
constexpr double floor_share = 0.1;

using SparseSum = std::vector<std::pair<uint32_t, double>>;

// Sum of the tile's rows, in wavelet space.
SparseSum tile_sum(TileGather& gather, const ViewTiles& tiles, int tile) {
  gather.gather(tiles.samples(tile), static_cast<uint64_t>(tile));
  SparseSum sum;
  for (const LaneCoefficient& c : gather.coefficients()) {
    double value = 0.0;
    for (const float v : c.value) value += static_cast<double>(v);
    sum.emplace_back(c.index, value);
  }
  return sum;
}

}  // namespace

std::vector<float> mean_row_scaling(const RayTracer& tracer, const DeepFrameBuffer& buffer,
                                    const GatherCloud& cloud, const GatherHierarchy& hierarchy,
                                    const FinalGatherSettings& settings) {
  const ViewTiles tiles(buffer);
  const std::vector<int> chosen = tiles.subset(settings.seed);
  tbb::enumerable_thread_specific<TileGather> gathers(
      [&] { return TileGather(tracer, cloud, hierarchy, settings, {}); });
  std::vector<SparseSum> sums(chosen.size());
  tbb::parallel_for(size_t{0}, chosen.size(),
                    [&](size_t i) { sums[i] = tile_sum(gathers.local(), tiles, chosen[i]); });

  std::vector<double> row(cloud.samples.size(), 0.0);
  for (const SparseSum& sum : sums)  // in order: the result must not depend on the number of threads
    for (const auto& [index, value] : sum) row[index] += value;
  row = wavelet::inverse(row);
  for (double& f : row) f = std::max(f, 0.0);  // rounding can leave tiny negative values
  const double mean = std::accumulate(row.begin(), row.end(), 0.0) / static_cast<double>(row.size());
  std::vector<float> scale(row.size(), 1.0f);
  if (mean > 0.0)
    std::transform(row.begin(), row.end(), scale.begin(),
                   [&](double f) { return static_cast<float>(f / mean + floor_share); });
  return scale;
}

}  // namespace relight::direct_to_indirect
