// The light models and BRDFs are one source compiled twice; here both compilations meet on random inputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/brdf/brdf.h"
#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/lights/light.h"
#include "common/sampling/random.h"
#include "tests/gpu/contexts.h"

namespace relight {
namespace {

struct Input {
  shader::LightParams light;
  glm::vec4 position, ns, ng, wo, wi, diffuse_exponent, glossy;
};
struct Output {
  glm::vec4 intensity, irradiance, brdf;
};

constexpr uint64_t input_count = 20000;

float uniform(uint64_t i, uint64_t dimension) { return random_float(11, 0, i, dimension); }

glm::vec3 random_vector(uint64_t i, uint64_t dimension) {
  return glm::vec3(uniform(i, dimension), uniform(i, dimension + 1), uniform(i, dimension + 2)) * 2.0f - 1.0f;
}

glm::vec3 random_direction(uint64_t i, uint64_t dimension) {
  return glm::normalize(random_vector(i, dimension) + glm::vec3(1e-3f));
}

Input random_input(uint64_t i) {
  Light light;
  light.type = i % 2 ? LightType::spot : LightType::omni;
  light.position = random_vector(i, 0) * 3.0f;
  light.direction = random_direction(i, 3);
  light.intensity = glm::abs(random_vector(i, 6)) * 10.0f;
  light.outer_degrees = 5.0f + 80.0f * uniform(i, 9);
  light.inner_degrees = light.outer_degrees * 0.8f * uniform(i, 10);
  const glm::vec3 n = random_direction(i, 11);
  const auto above = [&n](const glm::vec3& v) { return glm::dot(n, v) < 0.0f ? -v : v; };
  Input a;
  a.light = light.params();
  a.position = glm::vec4(random_vector(i, 14), 0.0f);
  a.ns = glm::vec4(n, 0.0f);
  a.ng = glm::vec4(glm::normalize(n + 0.3f * random_direction(i, 17)), 0.0f);
  a.wo = glm::vec4(above(random_direction(i, 20)), 0.0f);
  a.wi = glm::vec4(above(random_direction(i, 23)), 0.0f);
  a.diffuse_exponent = glm::vec4(glm::abs(random_vector(i, 26)), 100.0f * uniform(i, 29));
  a.glossy = i % 3 ? glm::vec4(glm::abs(random_vector(i, 30)), 0.0f) : glm::vec4(0.0f);
  return a;
}

Output on_cpu(const Input& a) {
  const shader::BrdfParams brdf{glm::vec3(a.diffuse_exponent), a.diffuse_exponent.w, glm::vec3(a.glossy), {}};
  const glm::vec3 ns(a.ns), wo(a.wo), wi(a.wi);
  return {glm::vec4(shader::light_intensity(a.light, wi), 0.0f),
          glm::vec4(shader::light_irradiance(a.light, glm::vec3(a.position), ns, glm::vec3(a.ng)), 0.0f),
          glm::vec4(shader::brdf_eval(brdf, ns, wo, wi), 0.0f)};
}

std::vector<Output> on_gpu(const std::vector<Input>& inputs) {
  const test::ShaderDir dir(RELIGHT_SOURCE_DIR);
  const gpu::Program program = gpu::Program::compute("tests/gpu/shared_source_test.glsl");
  const gpu::Buffer in = gpu::Buffer::from(inputs);
  const gpu::Buffer out(static_cast<int64_t>(inputs.size() * sizeof(Output)));
  in.bind_storage(0);
  out.bind_storage(1);
  program.set("count", static_cast<uint32_t>(inputs.size()));
  program.dispatch_items(static_cast<int64_t>(inputs.size()), 64);
  return out.download<Output>();
}

// |a - b| in units of 2^-24 times `scale`, the largest value that the expression's rounding refers to.
float error_in_ulps(const glm::vec4& a, const glm::vec4& b, float scale) {
  const glm::vec4 d = glm::abs(a - b);
  const float largest = std::max(std::max(d.x, d.y), d.z);
  return largest == 0.0f ? 0.0f : largest / (scale * 0x1p-24f);
}

float largest(const glm::vec4& v) { return std::max(std::max(v.x, v.y), v.z); }

struct Worst {
  float intensity = 0, irradiance = 0, brdf = 0;
};

Worst compare(const std::vector<Input>& inputs) {
  const std::vector<Output> gpu_outputs = on_gpu(inputs);
  Worst worst;
  for (size_t i = 0; i < inputs.size(); ++i) {
    const Input& a = inputs[i];
    const Output cpu = on_cpu(a), &gpu = gpu_outputs[i];
    // The smoothstep divides a cosine's rounding by the difference of the cone's cosines.
    const bool spot = a.light.position_type.w > 0.5f;
    const float sharpness = spot ? 1.5f / (a.light.intensity_inner.w - a.light.direction_outer.w) : 1.0f;
    const float intensity = largest(a.light.intensity_inner) * sharpness;
    const glm::vec3 to_light = glm::vec3(a.light.position_type) - glm::vec3(a.position);
    const float exponent = a.diffuse_exponent.w;
    const float lobe_peak = largest(a.glossy) * (exponent + 2.0f) / 6.2831853f;
    worst.intensity = std::max(worst.intensity, error_in_ulps(cpu.intensity, gpu.intensity, intensity));
    worst.irradiance = std::max(worst.irradiance, error_in_ulps(cpu.irradiance, gpu.irradiance,
                                                                intensity / glm::dot(to_light, to_light)));
    // pow magnifies the rounding of its base by the exponent.
    worst.brdf = std::max(
        worst.brdf,
        error_in_ulps(cpu.brdf, gpu.brdf, largest(a.diffuse_exponent) + lobe_peak * (1.0f + exponent)));
  }
  return worst;
}

std::vector<Input> random_inputs() {
  std::vector<Input> inputs;
  for (uint64_t i = 0; i < input_count; ++i) inputs.push_back(random_input(i));
  return inputs;
}

void expect_within_a_few_ulps(const char* backend) {
  const Worst worst = compare(random_inputs());
  EXPECT_LE(worst.intensity, 4.0f) << backend;
  EXPECT_LE(worst.irradiance, 8.0f) << backend;
  EXPECT_LE(worst.brdf, 8.0f) << backend;
}

// Red if the two compilations differ in more than rounding, e.g. a macro with another meaning in GLSL, or
// std430 and C++ disagree about LightParams.
TEST(SharedSource, LightModelsAndBrdfAgreeWithGlslWithinAFewUlpsOnOsmesa) {
  const auto context = gpu::Context::create("osmesa");
  expect_within_a_few_ulps("osmesa");
}

TEST(SharedSource, LightModelsAndBrdfAgreeWithGlslWithinAFewUlpsOnEgl) {
  std::string reason;
  const auto context = test::egl_or_null(reason);
  if (!context) GTEST_SKIP() << reason;
  expect_within_a_few_ulps("egl");
}

}  // namespace
}  // namespace relight
