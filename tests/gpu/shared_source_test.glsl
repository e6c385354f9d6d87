// Evaluates the sources that C++ and GLSL share on given inputs; read back and compared by shared_source_test.cpp.
#include "common/gpu/item_index.glsl"
#include "common/lights/light_models.glsl"
#include "common/brdf/brdf.glsl"

layout(local_size_x = 64) in;

struct Input {
  LightParams light;
  vec4 position, ns, ng, wo, wi;
  vec4 diffuse_exponent, glossy;
};
struct Output {
  vec4 intensity, irradiance, brdf;
};
layout(std430, binding = 0) readonly buffer Inputs { Input inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { Output outputs[]; };
uniform uint count;

void main() {
  uint i = item_index();
  if (i >= count) return;
  Input a = inputs[i];
  BrdfParams brdf = BrdfParams(a.diffuse_exponent.xyz, a.diffuse_exponent.w, a.glossy.xyz,
                               BrdfShape(0.0, 0.0, 0.0, 0u, 0u, 0u, 0u, 0u));
  outputs[i].intensity = vec4(light_intensity(a.light, a.wi.xyz), 0.0);
  outputs[i].irradiance = vec4(light_irradiance(a.light, a.position.xyz, a.ns.xyz, a.ng.xyz), 0.0);
  outputs[i].brdf = vec4(brdf_eval(brdf, a.ns.xyz, a.wo.xyz, a.wi.xyz), 0.0);
}
