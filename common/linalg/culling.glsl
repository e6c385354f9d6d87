// Whether a block of a transfer matrix is skipped (block_culling.h), and the count of the skipped.
#ifndef RELIGHT_CULLING
#define RELIGHT_CULLING

layout(std430, binding = 6) readonly buffer CullThreshold { float cull_threshold; };
layout(std430, binding = 7) buffer CullCounters { uint culled_blocks, culled_weights; };

// A light that is not a number is not culled: every comparison with it is false. threshold: cull_threshold, read once.
bool is_culled(vec3 light, float block_norm, float threshold) { return length(light) * block_norm <= threshold; }

#endif
