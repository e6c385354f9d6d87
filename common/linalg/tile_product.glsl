// One workgroup a screen tile of 16x8 pixels, one row of the tile an invocation (tile_product_gpu.h); the words of a block
// are described in screen_tiles.h. A whole row an invocation, because what a block costs under llvmpipe is reading its
// head and its light, once for each eight invocations.
#include "common/linalg/culling.glsl"
#include "common/linalg/stored_weights.glsl"
layout(local_size_x = 8) in;
layout(std430, binding = 0) readonly buffer TileStart { uint tile_start[]; };
layout(std430, binding = 1) readonly buffer Words { uint words[]; };
layout(std430, binding = 2) readonly buffer Vector { vec4 x[]; };
layout(std430, binding = 3) readonly buffer Scale { vec4 row_scale[]; };
layout(std430, binding = 4) writeonly buffer Result { vec4 y[]; };
uniform uint first_tile;
uniform uint tiles;
uniform uint tiles_across;
uniform uvec2 picture_size;

const uint group_words = uint(WEIGHT_BITS) / 8u;

void main() {
  uint local_tile = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (local_tile >= tiles) return;
  uint line = gl_LocalInvocationIndex;
  vec3 sum[16];
  for (int i = 0; i < 16; ++i) sum[i] = vec3(0.0f);
  uint skipped_blocks = 0u, skipped_weights = 0u;
  uint end = tile_start[local_tile + 1u];
  for (uint at = tile_start[local_tile]; at < end;) {
    uint head = words[at];
    uvec2 corner = uvec2(head, head >> 4) & uvec2(3u, 7u);
    uvec2 size = (uvec2(head >> 2, head >> 7) & uvec2(3u, 7u)) + 1u;
    vec3 light = x[head >> 10].rgb;
    if (is_culled(light, uintBitsToFloat(words[at + 2u]))) {
      skipped_blocks += 1u;
      skipped_weights += 4u * size.x * size.y;
    } else if (line - corner.y < size.y) {  // wraps to a large number above the rectangle
      light *= uintBitsToFloat(words[at + 1u]);
      uint first = at + 3u + (line - corner.y) * size.x * group_words;
      for (uint g = 0u; g < 4u; ++g) {  // unrolled: sum[] must stay in registers
        if (g - corner.x >= size.x) continue;
        vec4 w = STORED_WEIGHTS(words, first + (g - corner.x) * group_words);
        for (uint i = 0u; i < 4u; ++i) sum[4u * g + i] += w[i] * light;
      }
    }
    at += 3u + size.x * size.y * group_words;
  }
  uint tile = first_tile + local_tile;
  uvec2 pixel = uvec2(tile % tiles_across, tile / tiles_across) * uvec2(16u, 8u) + uvec2(0u, line);
  for (uint i = 0u; i < 16u; ++i) {
    if (pixel.x + i >= picture_size.x || pixel.y >= picture_size.y) continue;
    uint row = pixel.y * picture_size.x + pixel.x + i;
    y[row] = vec4(sum[i] * row_scale[row].rgb, 0.0f);
  }
  if (line == 0u && skipped_blocks > 0u) {
    atomicAdd(culled_blocks, skipped_blocks);
    atomicAdd(culled_weights, skipped_weights);
  }
}
