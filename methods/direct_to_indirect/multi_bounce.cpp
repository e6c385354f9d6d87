#include "methods/direct_to_indirect/multi_bounce.h"

#include <cmath>

#include <fmt/format.h>

#include "methods/direct_to_indirect/multi_bounce_photon_rows.h"
#include "methods/direct_to_indirect/multi_bounce_photons.h"
#include "methods/direct_to_indirect/multi_bounce_transfer.h"

namespace relight::direct_to_indirect {
namespace {

// Above this, what the picture lacks is easily seen.
constexpr double share_worth_a_warning = 0.05;

}  // namespace

MultiBounce compute_multi_bounce(const MultiBounceInput& input, const MultiBounceSettings& settings,
                                 Progress& progress, StageLog& log) {
  MultiBounce out;
  out.bounces = settings.bounces;
  if (settings.kind == BounceKind::photons) {
    const PhotonMap map = trace_photons(input, settings);
    log.count("photons", map.shot);
    log.count("photon_rays", map.rays);
    log.count("photon_hits", static_cast<int64_t>(map.photons.size()));
    out.share_beyond = share_beyond(map.power);
    out.photons = photon_rows(input, map, settings, progress, log);
    log.count("bounce_non_zeros", static_cast<int64_t>(out.photons.entries.size()));
  } else {
    out.transfer = transfer_rows(input, settings, progress, log);
    out.share_beyond = share_beyond(transfer_power(input, out.transfer, settings.bounces));
    log.count("bounce_non_zeros", static_cast<int64_t>(out.transfer.entries.size()));
  }
  return out;
}

double share_beyond(std::span<const double> power) {
  const double last = power.back(), before = power[power.size() - 2];
  if (!(last > 0.0)) return 0.0;
  if (last >= before) return 1.0;
  const double ratio = last / before, beyond = last * ratio / (1.0 - ratio);
  double simulated = 0.0;
  for (const double p : power) simulated += p;
  return beyond / (simulated + beyond);
}

void report_share_beyond(const MultiBounce& multi_bounce, StageLog& log) {
  const double share = multi_bounce.share_beyond;
  log.count("bounce_energy_beyond_ppm", std::llround(1e6 * share));
  if (share > share_worth_a_warning)
    log.warn(
        fmt::format("about {:.0f} % of the scene's light would come after more than the {} bounces that are "
                    "simulated (bounces={}), if every surface were lit evenly",
                    100.0 * share, multi_bounce.bounces, multi_bounce.bounces));
}

}  // namespace relight::direct_to_indirect
