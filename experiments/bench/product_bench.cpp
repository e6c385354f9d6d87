#include "experiments/bench/product_bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "common/gpu/timer.h"
#include "common/linalg/block_culling.h"
#include "common/linalg/product_list.h"
#include "common/shading/direct_lighting.h"
#include "common/wavelet/haar.h"
#include "experiments/compare/plan.h"
#include "experiments/options/parse.h"
#include "experiments/options/text_table.h"
#include "experiments/session/session.h"
#include "experiments/usage_error.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "methods/direct_to_indirect/precompute.h"

namespace relight {
namespace {

// What all forms multiply, and the right answer.
struct Problem {
  SparseRows matrix;
  std::vector<glm::vec3> scale;
  PictureShape shape;
  std::vector<glm::vec4> lights;
  std::vector<glm::dvec3> lights_exact;
  std::vector<glm::dvec3> answer;
};

std::vector<glm::dvec3> oracle(const Problem& p, const std::vector<glm::dvec3>& lights) {
  const std::vector<glm::vec3> sums = multiply(p.matrix, lights);
  std::vector<glm::dvec3> y(sums.size());
  for (size_t i = 0; i < y.size(); ++i) y[i] = glm::dvec3(sums[i]) * glm::dvec3(p.scale[i]);
  return y;
}

// Diffuse light leaving the gather samples under the session's lights, in wavelet space.
std::vector<glm::dvec3> wavelet_lights(Session& session, const GatherCloud& cloud) {
  const GpuSamples samples(cloud.samples, session.buffer().view.camera.eye);
  DirectLighting lighting(*session.gpu(), session.scene(), session.tracer(), {});
  gpu::Buffer out(static_cast<int64_t>(samples.size()) * 16);
  StageLog log;
  lighting.shade(session.lighting(), {{&samples, Lobes::diffuse, &out}}, log);
  std::vector<glm::dvec3> g;
  for (const glm::vec4& v : out.download<glm::vec4>()) g.emplace_back(v);
  return wavelet::forward(g);
}

Problem make_problem(Session& session, const KnobValues& knobs) {
  StageLog log;
  const PrepareContext context{session.scene(), session.tracer(),       session.buffer(),
                               knobs,           session.options().seed, *session.gpu(),
                               session.cache(), session.progress(),     log};
  direct_to_indirect::Artefact artefact = direct_to_indirect::load_or_precompute(context);
  Problem p;
  p.matrix = std::move(artefact.final_gather.diffuse);
  p.shape = {session.buffer().view.width, session.buffer().view.height};
  for (const SurfaceSample& s : session.buffer().indirect) p.scale.push_back(s.diffuse);
  p.lights_exact = wavelet_lights(session, artefact.cloud);
  for (const glm::dvec3& l : p.lights_exact) p.lights.emplace_back(glm::vec3(l), 0.0f);
  p.answer = oracle(p, p.lights_exact);
  return p;
}

template <typename Pixel>
double relative_error(const Problem& p, const std::vector<Pixel>& y) {
  double error = 0.0, norm = 0.0;
  for (size_t i = 0; i < y.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(y[i]) - p.answer[i];
    error += glm::dot(d, d), norm += glm::dot(p.answer[i], p.answer[i]);
  }
  return norm > 0.0 ? std::sqrt(error / norm) : std::sqrt(error);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Case {
  std::string device, form;
  ProductSettings settings;
};

struct Measured {
  double build_s = 0.0, min_ms = 0.0, median_ms = 0.0, error = 0.0;
  ProductStatistics stored;
  CullStatistics culled;
};

Measured measure(const Problem& p, const Case& c, int64_t max_block_bytes, int repeats) {
  Measured m;
  auto start = std::chrono::steady_clock::now();
  std::unique_ptr<TransferProduct> product;
  const TransferProductGpu* on_gpu = nullptr;
  if (c.device == "gpu") {
    auto made = make_product_gpu(c.form, p.matrix, p.scale, p.shape, c.settings, max_block_bytes);
    on_gpu = made.get();
    product = std::move(made);
  } else {
    product = make_product_cpu(c.form, p.matrix, p.scale, p.shape, c.settings);
  }
  m.build_s = seconds_since(start);
  std::vector<glm::vec4> y(p.scale.size());
  const gpu::Buffer x_buffer = gpu::Buffer::from(p.lights), y_buffer(static_cast<int64_t>(y.size()) * 16);
  std::vector<double> ms;
  for (int i = -1; i < repeats; ++i) {  // the first compiles shaders and touches memory
    start = std::chrono::steady_clock::now();
    if (on_gpu) {
      on_gpu->multiply(x_buffer, y_buffer);
      gpu::finish();
    } else {
      product->multiply(p.lights, y);
    }
    if (i >= 0) ms.push_back(1e3 * seconds_since(start));
  }
  std::sort(ms.begin(), ms.end());
  m.min_ms = ms.front();
  m.median_ms = ms[ms.size() / 2];
  if (on_gpu) y = y_buffer.download<glm::vec4>();
  m.error = relative_error(p, y);
  m.stored = product->statistics();
  m.culled = product->culled();
  return m;
}

std::vector<Case> cases() {
  std::vector<Case> out;
  ProductSettings settings;
  settings.cull_epsilon = -1.0f;  // nothing is culled
  for (const WeightFormat format : {WeightFormat::bits8, WeightFormat::bits16, WeightFormat::float32}) {
    settings.weights = format;
    for (const auto& [device, form] :
         {std::pair{"cpu", "rows"}, {"cpu", "tiles"}, {"gpu", "rows"}, {"gpu", "tiles"}, {"gpu", "quads"}})
      out.push_back({device, form, settings});
  }
  settings.weights = WeightFormat::bits8;
  settings.partial_results = PartialResults::float16;
  out.push_back({"gpu", "quads", settings});
  settings.partial_results = PartialResults::float32;
  for (const char* form : {"tiles", "quads"}) {
    for (const float epsilon : {0.0f, 1e-5f, 1e-4f, 1e-3f}) {
      settings.cull_epsilon = epsilon;
      out.push_back({"gpu", form, settings});
    }
  }
  settings.cull_epsilon = -1.0f;
  for (const float waste : {0.35f, 0.8f}) {
    settings.block_waste = waste;
    out.push_back({"gpu", "quads", settings});
  }
  return out;
}

std::string format_of(const Case& c) {
  std::string text = to_string(c.settings.weights);
  if (c.form == "quads") text += c.settings.partial_results == PartialResults::float16 ? ", sums 16" : "";
  if (c.form == "quads" && c.settings.block_waste != ProductSettings{}.block_waste)
    text += fmt::format(", waste {}", c.settings.block_waste);
  return text;
}

std::string product_table(const Problem& p, int64_t max_block_bytes, int repeats) {
  TextTable table({"product", "weights", "cull", "min ms", "median", "MB", "blocks", "waste", "fill",
                   "culled blocks", "weights", "error", "build s"});
  for (const Case& c : cases()) {
    const Measured m = measure(p, c, max_block_bytes, repeats);
    const auto share = [](int64_t part, int64_t all) {
      return all == 0 ? std::string("-")
                      : fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
    };
    table.add_row({c.device + " " + c.form, format_of(c),
                   c.settings.cull_epsilon < 0.0f ? "off" : fmt::format("{:g}", c.settings.cull_epsilon),
                   fmt::format("{:.1f}", m.min_ms), fmt::format("{:.1f}", m.median_ms),
                   fmt::format("{:.1f}", 1e-6 * static_cast<double>(m.stored.bytes)),
                   fmt::format("{}", m.stored.blocks), fmt::format("{:.1f} %", 100.0 * m.stored.waste()),
                   m.stored.atlases == 0 ? "-" : fmt::format("{:.1f} %", 100.0 * m.stored.atlas_fill),
                   share(m.culled.blocks, m.stored.blocks), share(m.culled.weights, m.stored.stored),
                   fmt::format("{:.2g}", m.error), fmt::format("{:.1f}", m.build_s)});
  }
  return table.to_string(3);
}

// Non-linear approximation of the lights: the error when only the heaviest are kept.
std::string ranking_table(const Problem& p) {
  std::vector<double> weight(p.matrix.columns, 0.0);
  std::vector<int64_t> entries(p.matrix.columns, 0);
  for (size_t row = 0; row < p.matrix.rows(); ++row) {
    const auto response = static_cast<double>(row_response(p.scale[row]));
    for (const SparseEntry& e : p.matrix.row(row)) {
      const double v = response * static_cast<double>(e.value);
      weight[e.column] += v * v;
      ++entries[e.column];
    }
  }
  for (size_t c = 0; c < weight.size(); ++c)
    weight[c] = std::sqrt(weight[c]) * glm::length(p.lights_exact[c]);
  std::vector<size_t> order(weight.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return weight[a] > weight[b]; });
  const auto active =
      static_cast<size_t>(std::count_if(weight.begin(), weight.end(), [](double w) { return w > 0.0; }));
  TextTable table({"lights kept", "of all that do something", "share of the non-zeros", "error"});
  for (const double share : {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0}) {
    const size_t kept = std::min(active, static_cast<size_t>(std::ceil(share * static_cast<double>(active))));
    std::vector<glm::dvec3> lights(p.lights_exact.size(), glm::dvec3(0.0));
    int64_t touched = 0;
    for (size_t i = 0; i < kept; ++i)
      lights[order[i]] = p.lights_exact[order[i]], touched += entries[order[i]];
    table.add_row(
        {fmt::format("{}", kept), fmt::format("{:.1f} %", 100.0 * share),
         fmt::format("{:.1f} %", 100.0 * static_cast<double>(touched) /
                                     static_cast<double>(std::max<size_t>(p.matrix.entries.size(), 1))),
         fmt::format("{:.2g}", relative_error(p, oracle(p, lights)))});
  }
  return table.to_string(0);
}

}  // namespace

std::string run_product_bench(const ProductBenchOptions& options) {
  if (options.repeats < 1 || options.repeats > 1000)
    usage_fail("--repeats {}: expected 1 to 1000", options.repeats);
  const std::unique_ptr<Method> method = make_direct_to_indirect();
  const MethodPlan plan = plan_method(*method, parse_settings(options.settings, {method.get()}));
  Session session(options.session, Session::Gpu::needed);
  const Problem p = make_problem(session, plan.knobs);
  return fmt::format("{} x {} pixels, {} columns, {} non-zeros, {}\n\n{}\n{}", p.shape.width, p.shape.height,
                     p.matrix.columns, p.matrix.entries.size(), session.gpu()->renderer(),
                     product_table(p, session.gpu()->max_storage_block_bytes(), options.repeats),
                     ranking_table(p));
}

}  // namespace relight
