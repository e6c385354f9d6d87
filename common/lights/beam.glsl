// The shape of a beam: what a projector and an uber-light let through, as a factor on the light of a point. One source
// for C++ (GLM) and GLSL; see common/glsl_in_cpp.h for the subset.
// This work is based on: Ronen Barzel, "Lighting Controls for Computer Cinematography", Journal of Graphics Tools 2(1),
// 1997 (the controls: superelliptic shape with soft edge, shear, cuts along the beam, falloff, slide).
#ifndef RELIGHT_BEAM
#define RELIGHT_BEAM

#ifdef RL_CPP
#define RL_SLIDE const vec4*
#define RL_SLIDE_TEXEL(slide, i) vec3((slide)[i])
#else
#define RL_SLIDE samplerBuffer
#define RL_SLIDE_TEXEL(slide, i) vec3(texelFetch(slide, i))
#endif

struct BeamParams {
  vec4 right_width;        // xyz unit; w: half width of full light at unit depth
  vec4 up_height;          // xyz unit; w: half height
  vec4 forward_roundness;  // xyz unit axis; w: 0 a rectangle .. 1 an ellipse
  vec4 edges_shear;        // how far beyond width and height the light fades out; shift of the centre at unit depth
  vec4 cuts;               // depths [scene units]: full light from x on, none before x - y; full to z, none after z + w
  vec4 falloff_slide;      // x: 2 - exponent; y: 1 / reference distance; z, w: texels of the slide
};

// The superelliptic norm ((u)^p + (v)^p)^(1/p), p = 2 / roundness, u and v >= 0; the maximum for roundness 0. Taken
// relative to the larger of both, no power overflows.
RL_FUNCTION float superelliptic_norm(float u, float v, float roundness) {
  float large = max(u, v), small = min(u, v);
  if (!(roundness > 0.0f) || !(small > 0.0f)) return large;
  return large * pow(1.0f + pow(small / large, 2.0f / roundness), 0.5f * roundness);
}

RL_FUNCTION float smooth_unit(float t) {
  float s = clamp(t, 0.0f, 1.0f);
  return s * s * (3.0f - 2.0f * s);
}

// 1 up to `inner`, 0 from `inner` + `edge` on, smooth between.
RL_FUNCTION float fade_out(float x, float inner, float edge) {
  if (x <= inner) return 1.0f;
  if (x >= inner + edge) return 0.0f;
  return 1.0f - smooth_unit((x - inner) / edge);
}

// How much of the light passes at (x, y) in the plane of unit depth. The ray from the centre through (x, y) leaves the
// inner curve at (x, y) / n_in and the outer one at (x, y) / n_out; the light fades between these two.
RL_FUNCTION float beam_shape(BeamParams beam, float x, float y) {
  float width = beam.right_width.w, height = beam.up_height.w;
  float u = abs(x), v = abs(y), roundness = beam.forward_roundness.w;
  float n_in = superelliptic_norm(u / width, v / height, roundness);
  if (n_in <= 1.0f) return 1.0f;
  float n_out = superelliptic_norm(u / (width + beam.edges_shear.x), v / (height + beam.edges_shear.y), roundness);
  if (n_out >= 1.0f || !(n_in > n_out)) return 0.0f;
  return 1.0f - smooth_unit((n_in - 1.0f) * n_out / (n_in - n_out));
}

// Bilinear; texel centres at half integers, beyond the outermost centres the border goes on. u to the right, v down.
RL_FUNCTION vec3 slide_lookup(RL_SLIDE slide, float columns, float rows, float u, float v) {
  float x = clamp(u * columns - 0.5f, 0.0f, columns - 1.0f), y = clamp(v * rows - 0.5f, 0.0f, rows - 1.0f);
  float left = floor(x), top = floor(y);
  float right = min(left + 1.0f, columns - 1.0f), bottom = min(top + 1.0f, rows - 1.0f);
  float a = x - left, b = y - top;
  vec3 upper = RL_SLIDE_TEXEL(slide, int(top * columns + left)) * (1.0f - a) +
               RL_SLIDE_TEXEL(slide, int(top * columns + right)) * a;
  vec3 lower = RL_SLIDE_TEXEL(slide, int(bottom * columns + left)) * (1.0f - a) +
               RL_SLIDE_TEXEL(slide, int(bottom * columns + right)) * a;
  return upper * (1.0f - b) + lower * b;
}

// Factor on the irradiance that a bare point of light gives at `rel`, the position relative to the light.
RL_FUNCTION vec3 beam_factor(BeamParams beam, RL_SLIDE slide, vec3 rel) {
  float depth = dot(vec3(beam.forward_roundness), rel);
  if (!(depth > 0.0f)) return vec3(0.0f);
  float x = dot(vec3(beam.right_width), rel) / depth - beam.edges_shear.z;
  float y = dot(vec3(beam.up_height), rel) / depth - beam.edges_shear.w;
  float factor = beam_shape(beam, x, y);
  factor = factor * fade_out(-depth, -beam.cuts.x, beam.cuts.y) * fade_out(depth, beam.cuts.z, beam.cuts.w);
  if (!(factor > 0.0f)) return vec3(0.0f);
  if (beam.falloff_slide.x != 0.0f)
    factor = factor * pow(sqrt(dot(rel, rel)) * beam.falloff_slide.y, beam.falloff_slide.x);
  float u = 0.5f + 0.5f * x / beam.right_width.w, v = 0.5f - 0.5f * y / beam.up_height.w;
  return slide_lookup(slide, beam.falloff_slide.z, beam.falloff_slide.w, u, v) * factor;
}

#endif
