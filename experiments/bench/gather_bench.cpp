#include "experiments/bench/gather_bench.h"

#include "common/sampling/gather_cloud.h"
#include "experiments/bench/replay.h"
#include "experiments/bench/timing.h"
#include "experiments/session/session.h"
#include "experiments/usage_error.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "methods/direct_to_indirect/final_gather.h"
#include "methods/direct_to_indirect/hierarchy.h"
#include "methods/direct_to_indirect/view_tiles.h"

namespace relight {
namespace {

using namespace direct_to_indirect;

// A link has a tenth of the rays of every pair: as many more tiles take about as long.
constexpr int more_tiles_with_links = 8;

// `wanted` tiles spread evenly, as FinalGatherInput::tiles, and how many view samples they and all tiles
// hold.
struct ChosenTiles {
  std::vector<uint8_t> mask;
  int64_t rows = 0, all_rows = 0;
};

ChosenTiles choose_tiles(const DeepFrameBuffer& buffer, int wanted) {
  const ViewTiles tiles(buffer);
  ChosenTiles chosen;
  for (int64_t t = 0; t < tiles.count(); ++t) {
    const bool kept = (t + 1) * wanted / tiles.count() != t * wanted / tiles.count();
    chosen.mask.push_back(kept ? 1 : 0);
    for (const SurfaceSample* s : tiles.samples(static_cast<int>(t))) {
      const int64_t row = s && s->valid ? 1 : 0;
      chosen.all_rows += row, chosen.rows += kept ? row : 0;
    }
  }
  return chosen;
}

struct Case {
  const char* name;
  float link_threshold;
  int tiles;
};

std::string measure(Session& session, const GatherCloud& cloud, const GatherHierarchy& hierarchy,
                    const Case& c, int repeats) {
  const ChosenTiles tiles = choose_tiles(session.buffer(), c.tiles);
  FinalGatherSettings settings;
  settings.link_threshold = c.link_threshold;
  settings.seed = session.options().seed;
  Progress quiet(true);
  StageLog log;
  const TrainingLights no_training;
  const auto gather = [&] {
    compute_final_gather(
        {session.tracer(), session.buffer(), cloud, hierarchy, {}, no_training, nullptr, nullptr, tiles.mask},
        settings, quiet, log);
  };
  RayLog rays;
  session.tracer().set_log(&rays);
  gather();
  session.tracer().set_log(nullptr);
  Replay replay(session.tracer(), rays);
  std::vector<double> whole, raw, share, cpu_share;
  for (int i = 0; i < repeats; ++i) {
    const Seconds g = seconds_of(gather), r = seconds_of([&] { replay.run(); });
    whole.push_back(g.wall), raw.push_back(r.wall);
    share.push_back(r.wall / g.wall), cpu_share.push_back(r.cpu / g.cpu);
  }
  const double million = 1e-6 * static_cast<double>(replay.counts().total());
  const auto rows = static_cast<double>(std::max<int64_t>(tiles.rows, 1));
  const double view_share = rows / static_cast<double>(std::max<int64_t>(tiles.all_rows, 1));
  return fmt::format("{:12} {:8} {:10.0f} {:10.1f} {:10.1f} {:7.2f} ({}) {:7.2f} ({}) {:12.0f}\n", c.name,
                     tiles.rows, 1e6 * million / rows, million / median(whole), million / median(raw),
                     median(share), spread(share), median(cpu_share), spread(cpu_share),
                     median(whole) / view_share);
}

}  // namespace

std::string run_gather_bench(const GatherBenchOptions& options) {
  if (options.tiles < 1 || options.tiles > 1024)
    usage_fail("--tiles {}: expected 1 to 1024 (all their rays are kept in memory)", options.tiles);
  if (options.repeats < 1 || options.repeats > 1000)
    usage_fail("--repeats {}: expected 1 to 1000", options.repeats);
  Session session(options.session, Session::Gpu::not_needed);
  const KnobValues paper(make_direct_to_indirect()->knobs());
  GatherCloud cloud;
  GatherHierarchy hierarchy;
  const Seconds cloud_time = seconds_of([&] {
    cloud = make_gather_cloud_for_view(session.tracer(), {session.buffer()}, CloudSampling::importance,
                                       options.gather_samples, session.options().seed);
  });
  const Seconds hierarchy_time = seconds_of([&] {
    order_gather_cloud(cloud, static_cast<float>(paper.real("hierarchy_k")),
                       session.scene().bounds.diagonal());
    hierarchy = build_hierarchy(cloud);
  });
  std::string out = fmt::format(
      "{} triangles, view {}x{}, {} gather samples: cloud {:.1f} s, hierarchy {:.1f} s\n\n"
      "{:12} {:>8} {:>10} {:>10} {:>10} {:>22} {:>22} {:>12}\n",
      session.scene().triangles.size(), session.buffer().view.width, session.buffer().view.height,
      cloud.samples.size(), cloud_time.wall, hierarchy_time.wall, "links", "rows", "rays a row", "Mrays/s",
      "Embree", "share of Embree", "in CPU time", "whole view s");
  for (const Case& c : {Case{"hierarchy", static_cast<float>(paper.real("link_threshold")),
                             options.tiles * more_tiles_with_links},
                        Case{"all", 0.0f, options.tiles}})
    out += measure(session, cloud, hierarchy, c, options.repeats);
  return out;
}

}  // namespace relight
