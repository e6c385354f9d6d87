// The form in which gather samples and links are kept for relighting (clustered gather paper, 2006, section
// 4).
#pragma once

#include <vector>

#include "common/run/knobs.h"
#include "common/shading/direct_lighting.h"
#include "methods/clustered_gather/view_clusters.h"

namespace relight::clustered_gather {

// The knob `storage`.
SampleFormat storage(const KnobValues& knobs);

// The samples on the GPU in that form. Empties `samples`, which would be as large again.
GpuSamples gpu_samples(std::vector<SurfaceSample>& samples, const glm::vec3& eye, SampleFormat format);

// The samples that shading on the CPU reads: rounded likewise, so that both devices and the oracle shade the
// same samples, but kept as floats.
std::vector<SurfaceSample> cpu_samples(std::vector<SurfaceSample> samples, SampleFormat format);

// Rounds the weights to 16-bit floats, unless the format is full. They then sum to 1 within 2^-11.
void round_weights(Links& links, SampleFormat format);

// Two links each, the last of an odd number with weight 0: cluster and weight of both (four words); or both
// clusters and both weights as 16-bit floats (three words), 6 bytes a link as in the paper.
std::vector<uint32_t> pack_links(const Links& links, SampleFormat format);

}  // namespace relight::clustered_gather
