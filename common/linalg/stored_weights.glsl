// Four weights from a buffer of words, in steps of their row or block: WEIGHT_BITS 8 or 16 are signed integers, lowest
// bits first, 32 are floats. A macro, because GLSL cannot pass a buffer.
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

#if WEIGHT_BITS == 8
#define STORED_WEIGHTS(words, at) signed_bytes(words[at])
#elif WEIGHT_BITS == 16
#define STORED_WEIGHTS(words, at) vec4(signed_halves(words[at]), signed_halves(words[(at) + 1u]))
#else
#define STORED_WEIGHTS(words, at) \
  uintBitsToFloat(uvec4(words[at], words[(at) + 1u], words[(at) + 2u], words[(at) + 3u]))
#endif

#endif
