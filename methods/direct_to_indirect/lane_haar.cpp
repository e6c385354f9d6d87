#include "methods/direct_to_indirect/lane_haar.h"

#include <bit>
#include <cstddef>

#include "common/wavelet/haar.h"

namespace relight::direct_to_indirect {
namespace {

const Lanes none{};

}  // namespace

Lanes analyse_lanes(const std::array<const Lanes*, 4>& child, uint32_t node, uint32_t nodes,
                    std::vector<LaneCoefficient>& out) {
  Lanes scaling;
  std::array<Lanes, 3> details;
  uint32_t any_bits = 0;  // of the details, but for their signs
  for (size_t i = 0; i < lanes; ++i) {
    float d[3];
    scaling[i] = wavelet::haar_step((*child[0])[i], (*child[1])[i], (*child[2])[i], (*child[3])[i], d);
    for (size_t t = 0; t < 3; ++t) {
      details[t][i] = d[t];
      any_bits |= std::bit_cast<uint32_t>(d[t]) & 0x7fffffffu;
    }
  }
  if (any_bits)
    for (uint32_t t = 0; t < 3; ++t) out.push_back({(t + 1) * nodes + node, details[t]});
  return scaling;
}

void forward_lanes(std::vector<LaneCoefficient>& values, uint32_t n, std::vector<LaneCoefficient>& out) {
  if (values.empty()) return;
  for (uint32_t nodes = n / 4; nodes > 0; nodes /= 4) {
    size_t made = 0;
    for (size_t at = 0; at < values.size();) {
      const uint32_t node = values[at].index / 4;
      std::array<const Lanes*, 4> child{&none, &none, &none, &none};
      for (; at < values.size() && values[at].index / 4 == node; ++at)
        child[values[at].index % 4] = &values[at].value;
      // Safe in place: `made` never overtakes the children just read, and the result is complete by then.
      values[made++] = {node, analyse_lanes(child, node, nodes, out)};
    }
    values.resize(made);
  }
  out.push_back({0, values[0].value});
}

}  // namespace relight::direct_to_indirect
