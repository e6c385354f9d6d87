// One workgroup a screen tile of 16x8 pixels, one row of the tile an invocation (tile_product_gpu.h); the words of a block
// are described in screen_tiles.h. A whole row an invocation, because what a block costs under llvmpipe is reading its
// head and its light, once for each eight invocations.
#include "common/linalg/culling.glsl"
#include "common/linalg/stored_weights.glsl"
layout(local_size_x = 8) in;
layout(std430, binding = 0) readonly buffer TileStart { uint tile_start[]; };
layout(binding = 1) uniform usamplerBuffer blocks;
layout(binding = 2) uniform samplerBuffer x;
layout(std430, binding = 3) readonly buffer Scale { vec4 row_scale[]; };
layout(std430, binding = 4) writeonly buffer Result { vec4 y[]; };
uniform uint first_tile;
uniform uint tiles;
uniform uint tiles_across;
uniform uvec2 picture_size;

const int line_texels = WEIGHT_BITS / 8;

void main() {
  uint local_tile = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (local_tile >= tiles) return;
  uint line = gl_LocalInvocationIndex;
  vec3 sum[16];
  for (int i = 0; i < 16; ++i) sum[i] = vec3(0.0f);
  uint skipped_blocks = 0u, skipped_weights = 0u;
  float threshold = cull_threshold;
  int end = int(tile_start[local_tile + 1u]);
  for (int at = int(tile_start[local_tile]); at < end;) {
    uvec4 head = texelFetch(blocks, at);
    uint top = head.x & 7u, lines = (head.x >> 3 & 7u) + 1u;
    vec3 light = texelFetch(x, int(head.x >> 8)).rgb;
    if (is_culled(light, uintBitsToFloat(head.z), threshold)) {
      skipped_blocks += 1u;
      skipped_weights += 16u * lines;
    } else if (line - top < lines) {  // wraps to a large number above the block
      light *= uintBitsToFloat(head.y);
      int first = at + 1 + int(line - top) * line_texels;
      for (int t = 0; t < line_texels; ++t) {  // unrolled: sum[] must stay in registers
        uvec4 texel = texelFetch(blocks, first + t);
        for (int g = 0; g < texel_weights / 4; ++g) {
          vec4 w = stored_weights(texel, g);
          for (int i = 0; i < 4; ++i) sum[t * texel_weights + 4 * g + i] += w[i] * light;
        }
      }
    }
    at += 1 + int(lines) * line_texels;
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
