// Weight times wavelet light; blending adds it to the picture (GPU Gems 3, listing 9-9).
#if WEIGHT_BITS == 32
uniform sampler2D atlas;
#else
uniform usampler2D atlas;
#endif
flat in vec3 light_step;
flat in float origin;
flat in ivec2 to_texel;
layout(location = 0) out vec4 result;

void main() {
  float stored = float(texelFetch(atlas, ivec2(gl_FragCoord.xy) + to_texel, 0).r);
  result = vec4((stored + origin) * light_step, 0.0f);
}
