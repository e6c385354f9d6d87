// Precompute and relight of direct-to-indirect transfer, equation 7 with M = 0:
//   v_i = k_d * (F_d^w (W g_d)),  image = direct + upsampled v_i.
#include <algorithm>

#include "common/gpu/context.h"
#include "common/gpu/timer.h"
#include "common/linalg/sparse_product_gpu.h"
#include "common/run/artefact_cache.h"
#include "common/run/error.h"
#include "common/sampling/gather_cloud.h"
#include "common/shading/direct_lighting.h"
#include "common/shading/reconstruction.h"
#include "common/wavelet/haar.h"
#include "common/wavelet/haar_gpu.h"
#include "methods/direct_to_indirect/artefact.h"
#include "methods/direct_to_indirect/column_scaling.h"
#include "methods/direct_to_indirect/direct_to_indirect.h"
#include "methods/direct_to_indirect/final_gather.h"
#include "methods/direct_to_indirect/hierarchy.h"
#include "methods/direct_to_indirect/knobs.h"
#include "methods/direct_to_indirect/training_lights.h"

namespace relight {
namespace direct_to_indirect {
namespace {

FinalGatherSettings final_gather_settings(const PrepareContext& context) {
  const KnobValues& knobs = context.knobs;
  FinalGatherSettings settings;
  settings.link_threshold = static_cast<float>(knobs.real("link_threshold"));
  settings.form_factor_clamp = static_cast<float>(knobs.real("form_factor_clamp"));
  settings.coefficients = static_cast<int>(knobs.integer("coefficients"));
  settings.support_exponent = static_cast<float>(knobs.real("support_exponent"));
  settings.shared_budget = knobs.choice("row_budget") == "shared";
  settings.refit_ridge = static_cast<float>(knobs.real("refit_ridge"));
  settings.seed = context.seed;
  return settings;
}

Artefact precompute(const PrepareContext& context) {
  const KnobValues& knobs = context.knobs;
  Artefact artefact;
  {
    StageTimer timer(context.log, "gather_cloud");
    const CloudSampling sampling =
        knobs.choice("cloud") == "importance" ? CloudSampling::importance : CloudSampling::uniform;
    artefact.cloud = make_gather_cloud_for_view(context.tracer, context.buffer, sampling, 1,
                                                knobs.integer("gather_samples"), context.seed);
  }
  GatherHierarchy hierarchy;
  {
    StageTimer timer(context.log, "hierarchy");
    order_gather_cloud(artefact.cloud, static_cast<float>(knobs.real("hierarchy_k")),
                       context.scene.bounds.diagonal());
    hierarchy = build_hierarchy(artefact.cloud);
  }
  const FinalGatherSettings settings = final_gather_settings(context);
  std::vector<float> scale;
  if (knobs.choice("column_scaling") == "mean_row") {
    StageTimer timer(context.log, "column_scaling");
    scale = mean_row_scaling(context.tracer, context.buffer, artefact.cloud, hierarchy, settings);
  }
  TrainingLights training;
  const auto lights = static_cast<uint32_t>(knobs.integer("refit_lights"));
  if (lights > 0) {
    StageTimer timer(context.log, "training_lights");
    training =
        make_training_lights(context.tracer, context.buffer, artefact.cloud, scale, lights, context.seed);
    context.log.bytes("training_lights", static_cast<int64_t>(training.response.size() * sizeof(float)));
  }
  StageTimer timer(context.log, "final_gather");
  const FinalGatherInput input{context.tracer, context.buffer, artefact.cloud, hierarchy, scale, training};
  artefact.final_gather = compute_final_gather(input, settings, context.progress, context.log);
  for (size_t j = 0; j < scale.size(); ++j) artefact.cloud.samples[j].diffuse *= scale[j];
  return artefact;
}

// The artefact from the cache, or computed and stored. A cache that cannot be written costs a warning, not
// the run.
Artefact load_or_precompute(const PrepareContext& context) {
  const std::string kind = "direct_to_indirect.final_gather", key = cache_key(context);
  {
    StageTimer timer(context.log, "cache_load");
    if (const auto bytes = context.cache.load(kind, key)) {
      context.log.count("cache_hits", 1);
      return from_bytes(*bytes);
    }
  }
  Artefact artefact = precompute(context);
  StageTimer timer(context.log, "cache_store");
  try {
    if (context.cache.enabled()) context.cache.store(kind, key, to_bytes(artefact));
  } catch (const Error& error) {
    context.log.warn(std::string("precomputed data was not cached: ") + error.what());
  }
  return artefact;
}

std::vector<glm::vec3> diffuse_albedo(const DeepFrameBuffer& buffer) {
  std::vector<glm::vec3> kd(buffer.indirect.size());
  std::transform(buffer.indirect.begin(), buffer.indirect.end(), kd.begin(),
                 [](const SurfaceSample& s) { return s.diffuse; });
  return kd;
}

class PreparedTransfer : public Prepared {
 public:
  PreparedTransfer(const PrepareContext& context, Artefact artefact)
      : matrix_(std::move(artefact.final_gather)),
        kd_(diffuse_albedo(context.buffer)),
        on_cpu_(context.knobs.choice("device") == "cpu"),
        gather_(artefact.cloud.samples, context.buffer.view.camera.eye),
        view_(context.buffer.direct, context.buffer.view.camera.eye),
        lighting_(context.gpu, context.scene, context.tracer,
                  {context.knobs.choice("shadows") == "map" ? Shadows::map : Shadows::traced,
                   static_cast<int>(context.knobs.integer("shadow_map_size"))}),
        haar_(static_cast<int64_t>(artefact.cloud.samples.size())),
        product_(matrix_, kd_, context.gpu.max_storage_block_bytes()),
        reconstruction_(context.buffer),
        gather_direct_(static_cast<int64_t>(gather_.size()) * 16),
        view_direct_(static_cast<int64_t>(view_.size()) * 16),
        indirect_(static_cast<int64_t>(kd_.size()) * 16) {
    context.log.bytes("final_gather_matrix", matrix_.bytes());
    context.log.bytes("final_gather_matrix_gpu", product_.bytes());
    context.log.bytes("gather_samples", gather_.bytes());
    context.log.bytes("view_samples", view_.bytes());
    context.log.bytes("lighting", lighting_.bytes());
    context.log.bytes("partial_results",
                      gather_direct_.bytes() + view_direct_.bytes() + indirect_.bytes() + haar_.bytes());
  }

  Relit relight(const LightingState& lighting, StageLog& log) override {
    lighting_.shade(lighting,
                    {{&gather_, Lobes::diffuse, &gather_direct_}, {&view_, Lobes::all, &view_direct_}}, log);
    if (on_cpu_)
      transfer_on_cpu(log);
    else
      transfer_on_gpu(log);
    Reconstruction::Images images = reconstruction_.resolve(view_direct_, indirect_, log);
    Relit out{std::move(images.direct), std::move(images.indirect), {}};
    out.total = out.direct;
    for (size_t i = 0; i < out.total.pixels.size(); ++i) out.total.pixels[i] += out.indirect.pixels[i];
    return out;
  }

 private:
  void transfer_on_gpu(StageLog& log) {
    {
      StageTimer timer(log, "wavelet_transform");
      haar_.forward(gather_direct_);
      gpu::finish();
    }
    StageTimer timer(log, "transfer");
    product_.multiply(haar_.coefficients(), indirect_);
    gpu::finish();
  }

  // The double-precision twin: the oracle of the GPU path.
  void transfer_on_cpu(StageLog& log) {
    std::vector<glm::dvec3> g;
    {
      StageTimer timer(log, "wavelet_transform");
      for (const glm::vec4& v : gather_direct_.download<glm::vec4>()) g.emplace_back(v);
      g = wavelet::forward(g);
    }
    StageTimer timer(log, "transfer");
    const std::vector<glm::vec3> sums = relight::multiply(matrix_, g);
    std::vector<glm::vec4> v(sums.size());
    for (size_t i = 0; i < v.size(); ++i) v[i] = glm::vec4(sums[i] * kd_[i], 0.0f);
    indirect_.upload(0, indirect_.bytes(), v.data());
  }

  SparseRows matrix_;
  std::vector<glm::vec3> kd_;
  bool on_cpu_;
  GpuSamples gather_, view_;
  DirectLighting lighting_;
  wavelet::HaarGpu haar_;
  SparseProductGpu product_;
  Reconstruction reconstruction_;
  gpu::Buffer gather_direct_, view_direct_, indirect_;
};

class DirectToIndirect : public Method {
 public:
  std::string name() const override { return "direct_to_indirect"; }
  std::string summary() const override {
    return "Direct light on a gather cloud, carried to the view by a sparse matrix in wavelet space "
           "(diffuse, one bounce).";
  }
  std::string paper() const override {
    return "Hasan, Pellacini, Bala: Direct-to-Indirect Transfer for Cinematic Relighting, SIGGRAPH 2006";
  }
  KnobTable knobs() const override { return knob_table(); }
  LightPaths light_paths(const KnobValues&) const override { return {}; }
  std::unique_ptr<Prepared> prepare(const PrepareContext& context) const override {
    Artefact artefact = load_or_precompute(context);
    StageTimer timer(context.log, "upload");
    return std::make_unique<PreparedTransfer>(context, std::move(artefact));
  }
};

}  // namespace
}  // namespace direct_to_indirect

std::unique_ptr<Method> make_direct_to_indirect() {
  return std::make_unique<direct_to_indirect::DirectToIndirect>();
}

}  // namespace relight
