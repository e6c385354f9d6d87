// Weights as they lie in texels of four words, in steps of their row or block: WEIGHT_BITS 8 or 16 are signed integers,
// lowest bits first, 32 are floats.
#ifndef RELIGHT_STORED_WEIGHTS
#define RELIGHT_STORED_WEIGHTS

vec4 signed_bytes(uint word) {
  int w = int(word);
  return vec4(float(w << 24 >> 24), float(w << 16 >> 24), float(w << 8 >> 24), float(w >> 24));
}
vec2 signed_halves(uint word) {
  int w = int(word);
  return vec2(float(w << 16 >> 16), float(w >> 16));
}

const int texel_weights = 128 / WEIGHT_BITS;

// Weights [4 g, 4 g + 4) of a texel.
vec4 stored_weights(uvec4 texel, int g) {
#if WEIGHT_BITS == 8
  return signed_bytes(texel[g]);
#elif WEIGHT_BITS == 16
  return vec4(signed_halves(texel[2 * g]), signed_halves(texel[2 * g + 1]));
#else
  return uintBitsToFloat(texel);
#endif
}

#endif
