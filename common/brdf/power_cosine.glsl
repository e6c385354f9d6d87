// The distribution (e+1)/(2 pi) cos^e about an axis, which three of the models sample.
#ifndef RELIGHT_POWER_COSINE
#define RELIGHT_POWER_COSINE

// ln(1 - x) / x for x in [0,1); rest = 1 - x, which the caller may know better than by subtraction. A series near 0,
// where the logarithm loses the digits that a large exponent asks for; its first term left out is below 2^-28 at the
// switch.
RL_FUNCTION float log_rest_over(float x, float rest) {
  if (x < 0.05f)
    return -(1.0f +
             x * (1.0f / 2.0f + x * (1.0f / 3.0f + x * (1.0f / 4.0f + x * (1.0f / 5.0f + x * (1.0f / 6.0f))))));
  return log(max(rest, 1e-30f)) / x;
}

#ifndef RL_CPP
// (cosine, sine) of the angle to the axis: cos = (1-u)^(1/(e+1)), u in [0,1). brdf.h has it in double for C++.
RL_FUNCTION vec2 sample_power_cosine_angle(float u, float exponent) {
  float log_cosine = log_rest_over(u, 1.0f - u) * u / (exponent + 1.0f);
  float cosine = exp(log_cosine);
  // 1 - cos^2 = -(exp(2 l) - 1): a series near 0, where 1 - cos^2 cancels.
  float x = -2.0f * log_cosine;
  float squared = x < 0.1f ? x * (1.0f - x * (1.0f / 2.0f - x * (1.0f / 6.0f - x * (1.0f / 24.0f)))) : 1.0f - exp(-x);
  return vec2(cosine, sqrt(max(0.0f, squared)));
}
#endif

// Direction about `axis` (unit) from u in [0,1)^2.
RL_FUNCTION vec3 sample_power_cosine(vec3 axis, float exponent, vec2 u) {
  vec2 angle = sample_power_cosine_angle(u.x, exponent);
  float phi = 2.0f * rl_pi * u.y;
  mat3 frame = frame_with_sign(axis, floatBitsToInt(axis.z) < 0 ? -1.0f : 1.0f);
  return frame * vec3(angle.y * cos(phi), angle.y * sin(phi), angle.x);
}

RL_FUNCTION float power_cosine_pdf(float cosine, float exponent) {
  return cosine > 0.0f ? (exponent + 1.0f) / (2.0f * rl_pi) * pow(cosine, exponent) : 0.0f;
}

#endif
