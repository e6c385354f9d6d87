#include "experiments/explain/measures.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "common/image/noise_statistics.h"
#include "common/run/error.h"

namespace relight {
namespace {

glm::dvec3 seen(const glm::vec3& v, double exposure, bool clamped) {
  const glm::dvec3 value(v);
  return clamped ? glm::clamp(exposure * value, 0.0, 1.0) : value;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// share() without one block.
double share_without(const BlockSums& sums, size_t block, double difference, double reference) {
  return std::sqrt(std::max(0.0, difference - sums.difference[block]) / (reference - sums.reference[block]));
}

}  // namespace

const std::array<std::string, measure_count>& measure_names() {
  static const std::array<std::string, measure_count> names = {"relative", "relative_edges_out",
                                                               "indirect_linear"};
  return names;
}

BlockSums block_sums(const Picture& a, const Picture& b, const Picture& reference,
                     const PictureLayout& layout, Measure::Kind measure) {
  const bool linear = measure == Measure::indirect_linear;
  const auto of = [&](const Picture& p) -> const std::vector<glm::vec3>& {
    return linear ? p.indirect.pixels : p.total.pixels;
  };
  const size_t pixels = of(reference).size();
  if (of(a).size() != pixels || of(b).size() != pixels || layout.edge.size() != pixels ||
      layout.block.size() != pixels)
    fail("waterfall: pictures of {} and {} pixels, a reference of {}, {} edge marks and {} block numbers",
         of(a).size(), of(b).size(), pixels, layout.edge.size(), layout.block.size());
  const auto exposure = static_cast<double>(layout.exposure);
  BlockSums sums;
  for (size_t i = 0; i < pixels; ++i) {
    const auto block = static_cast<size_t>(layout.block[i]);
    if (block >= sums.difference.size()) sums.difference.resize(block + 1), sums.reference.resize(block + 1);
    if (measure == Measure::relative_edges_out && layout.edge[i]) continue;
    const glm::dvec3 r = seen(of(reference)[i], exposure, !linear),
                     d = seen(of(a)[i], exposure, !linear) - seen(of(b)[i], exposure, !linear);
    sums.difference[block] += glm::dot(d, d);
    sums.reference[block] += glm::dot(r, r);
  }
  return sums;
}

double share(const BlockSums& sums) {
  const double reference = sum(sums.reference);
  return reference > 0.0 ? std::sqrt(sum(sums.difference) / reference)
                         : std::numeric_limits<double>::quiet_NaN();
}

double half_width_of_drop(const BlockSums& from, const BlockSums& to) {
  const size_t blocks = from.difference.size();
  if (blocks < 2) return std::numeric_limits<double>::quiet_NaN();
  const double n = static_cast<double>(blocks);
  const double d0 = sum(from.difference), r0 = sum(from.reference);
  const double d1 = sum(to.difference), r1 = sum(to.reference);
  std::vector<double> drops(blocks);
  for (size_t b = 0; b < blocks; ++b)
    drops[b] = share_without(from, b, d0, r0) - (to.difference.empty() ? 0.0 : share_without(to, b, d1, r1));
  const double mean = sum(drops) / n;
  double squares = 0.0;
  for (const double drop : drops) squares += (drop - mean) * (drop - mean);
  return normal_quantile_95 * std::sqrt((n - 1.0) / n * squares);
}

}  // namespace relight
