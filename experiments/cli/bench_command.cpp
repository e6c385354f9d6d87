// relight bench
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "experiments/bench/bench.h"
#include "experiments/bench/gather_bench.h"
#include "experiments/bench/product_bench.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/session_flags.h"

namespace relight::cli {

void add_bench_command(Command& app, Action& action) {
  Command* command = app.add_subcommand(
      "bench", "Speed of the path tracer in million rays a second, beside Embree alone on the same rays");
  const auto options = std::make_shared<BenchOptions>();
  options->session.view = "320x240";
  add_session_flags(*command, options->session);
  command->add_option("--bounces", options->bounces, "Bounces of indirect light")
      ->type_name("A..B")
      ->capture_default_str();
  command->add_option("--samples", options->samples, "Paths a pixel; every ray is kept in memory")
      ->capture_default_str();
  command->add_option("--repeats", options->repeats, "Times to measure")->capture_default_str();
  command->add_option("--estimator", options->estimator, "How paths are sampled")
      ->type_name("next_event|light_vertex")
      ->capture_default_str();
  const auto products = std::make_shared<ProductBenchOptions>();
  const auto bench_products = std::make_shared<bool>(false);
  command->add_flag("--products", *bench_products,
                    "Instead: the forms of direct_to_indirect's sparse product, side by side");
  command
      ->add_option("--set", products->settings,
                   "With --products: a knob of direct_to_indirect; may be repeated")
      ->type_name("METHOD.KNOB=VALUE")
      ->allow_extra_args(false);
  const auto gather = std::make_shared<GatherBenchOptions>();
  const auto bench_gather = std::make_shared<bool>(false);
  command->add_flag("--gather", *bench_gather,
                    "Instead: direct_to_indirect's final gather, beside Embree alone on the same packets");
  command->add_option("--tiles", gather->tiles, "With --gather: tiles of 4x4 pixels whose rows are made")
      ->capture_default_str();
  command->callback([&action, options, products, bench_products, gather, bench_gather] {
    action = [options, products, bench_products, gather, bench_gather] {
      products->session = options->session;
      products->repeats = options->repeats;
      gather->session = options->session;
      gather->repeats = options->repeats;
      fmt::print("{}", *bench_gather     ? run_gather_bench(*gather)
                       : *bench_products ? run_product_bench(*products)
                                         : run_bench(*options));
      return 0;
    };
  });
}

}  // namespace relight::cli
