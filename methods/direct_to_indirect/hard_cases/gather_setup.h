// A scene, its tracer, a deep frame buffer and a gather cloud, for hard cases and tests.
#pragma once

#include <utility>

#include "common/sampling/deep_frame_buffer.h"
#include "common/sampling/gather_cloud.h"
#include "common/tracing/ray_tracer.h"
#include "methods/direct_to_indirect/final_gather.h"
#include "methods/direct_to_indirect/hierarchy.h"
#include "methods/direct_to_indirect/near_field.h"

namespace relight::direct_to_indirect {

struct GatherSetup {
  Scene scene;
  RayTracer tracer;
  DeepFrameBuffer buffer;
  GatherCloud cloud;
  GatherHierarchy hierarchy;

  GatherSetup(Scene s, int width, int height, int64_t samples, bool both_sides = false)
      : scene(std::move(s)),
        tracer(scene),
        buffer(make_deep_frame_buffer(scene, tracer, {scene.camera, width, height})),
        cloud(both_sides
                  ? even_cloud(samples)
                  : make_gather_cloud_for_view(tracer, {buffer}, CloudSampling::importance, samples, 1)) {
    order_gather_cloud(cloud, 30.0f, scene.bounds.diagonal());
    hierarchy = build_hierarchy(cloud);
  }

  // Evenly over both sides of everything, whatever the view.
  GatherCloud even_cloud(int64_t samples) const {
    std::vector<SurfacePiece> pieces = cut_surfaces(scene, 1e30);
    return make_gather_cloud(tracer, pieces, samples, 1);
  }

  SparseRows final_gather(const FinalGatherSettings& settings, const std::vector<float>& column_scale = {},
                          const TrainingLights& training = {}, const NearField* near_field = nullptr) {
    Progress progress(true);
    StageLog log;
    return compute_final_gather({tracer, buffer, cloud, hierarchy, column_scale, training, near_field},
                                settings, progress, log)
        .diffuse;
  }
};

// Settings that make no approximation beyond the gather samples themselves.
inline FinalGatherSettings exact_settings(int coefficients) {
  FinalGatherSettings settings;
  settings.link_threshold = 0.0f;
  settings.form_factor_clamp = 1e30f;
  settings.coefficients = coefficients;
  return settings;
}

// Row `row` of the matrix as a dense vector of coefficients.
inline std::vector<double> dense_row(const SparseRows& m, size_t row) {
  std::vector<double> dense(m.columns, 0.0);
  for (uint64_t e = m.row_start[row]; e < m.row_start[row + 1]; ++e)
    dense[m.entries[e].column] = static_cast<double>(m.entries[e].value);
  return dense;
}

}  // namespace relight::direct_to_indirect
