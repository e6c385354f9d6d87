// Evaluates and samples the models on given inputs; read back and compared by brdf_glsl_test.cpp.
#include "common/gpu/item_index.glsl"
#include "common/brdf/brdf_sampling.glsl"

layout(local_size_x = 64) in;

struct Input {
  vec4 diffuse_exponent, glossy_lobe, n, wo, wi;  // glossy_lobe.w: u_lobe; n.w and wo.w: u
  BrdfShape shape;
};
struct Output {
  vec4 value_pdf, sampled;
};
layout(std430, binding = 0) readonly buffer Inputs { Input inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { Output outputs[]; };
uniform uint count;

void main() {
  uint i = item_index();
  if (i >= count) return;
  Input a = inputs[i];
  BrdfParams brdf = BrdfParams(a.diffuse_exponent.xyz, a.diffuse_exponent.w, a.glossy_lobe.xyz, a.shape);
  outputs[i].value_pdf = vec4(brdf_eval(brdf, a.n.xyz, a.wo.xyz, a.wi.xyz),
                              brdf_mixture_pdf(brdf, a.n.xyz, a.wo.xyz, a.wi.xyz));
  outputs[i].sampled = brdf_mixture_sample(brdf, a.n.xyz, a.wo.xyz, a.glossy_lobe.w, vec2(a.n.w, a.wo.w));
}
