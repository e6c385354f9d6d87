// Every model, compiled as GLSL, against its compilation as C++.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "common/gpu/buffer.h"
#include "common/gpu/program.h"
#include "common/sampling/random.h"
#include "tests/brdf/brdf_cases.h"
#include "tests/gpu/contexts.h"

namespace relight {
namespace {

struct Input {
  glm::vec4 diffuse_exponent, glossy_lobe, n, wo, wi;
  shader::BrdfShape shape;
};
struct Output {
  glm::vec4 value_pdf, sampled;
};

shader::BrdfParams brdf_of(const Input& a) {
  return {glm::vec3(a.diffuse_exponent), a.diffuse_exponent.w, glm::vec3(a.glossy_lobe), a.shape};
}

// Half of the incoming directions are sampled ones, where the lobes are.
Input random_input(const shader::BrdfParams& brdf, uint64_t i) {
  const auto u = [i](uint64_t dimension) { return random_float(21, 0, i, dimension); };
  const glm::vec3 n = test::direction(2.0 * double(u(0)) - 1.0, 6.28 * double(u(1)));
  const glm::mat3 frame = frame_around(n);
  Input a{};
  a.diffuse_exponent = glm::vec4(brdf.diffuse, brdf.exponent);
  a.glossy_lobe = glm::vec4(brdf.glossy, u(2));
  a.n = glm::vec4(n, u(3));
  a.wo = glm::vec4(frame * test::direction(0.02 + 0.98 * double(u(4)), 6.28 * double(u(5))), u(6));
  a.wi = glm::vec4(frame * test::direction(u(7), 6.28 * double(u(8))), 0.0f);
  a.shape = brdf.shape;
  const BrdfSample s = sample_brdf(brdf, n, glm::vec3(a.wo), u(9), {u(10), u(11)}, false);
  if (i % 2 && s.pdf > 0.0f) a.wi = glm::vec4(s.wi, 0.0f);
  return a;
}

std::vector<Output> on_gpu(const std::vector<Input>& inputs) {
  const test::ShaderDir dir(RELIGHT_SOURCE_DIR);
  const gpu::Program program = gpu::Program::compute("tests/brdf/brdf_glsl_test.glsl");
  const gpu::Buffer in = gpu::Buffer::from(inputs);
  const gpu::Buffer out(static_cast<int64_t>(inputs.size() * sizeof(Output)));
  in.bind_storage(0);
  out.bind_storage(1);
  program.set("count", static_cast<uint32_t>(inputs.size()));
  program.dispatch_items(static_cast<int64_t>(inputs.size()), 64);
  return out.download<Output>();
}

// How much narrower than 1 rad the narrowest lobe is: rounding of a direction moves the value by this much
// more.
float sharpness(const shader::BrdfParams& brdf) {
  const uint32_t model = shader::brdf_model(brdf.shape);
  const float a = brdf.exponent, b = brdf.shape.exponent_v;
  if (model == shader::brdf_ggx) return 1.0f / std::min(a, b);
  return 1.0f + (model == shader::brdf_phong ? a : std::max(std::max(a, b), brdf.shape.exponent_w));
}

struct Worst {
  float value = 0, pdf = 0, direction = 0;
};

Worst compare(const shader::BrdfParams& brdf, const std::vector<Input>& inputs) {
  const std::vector<Output> outputs = on_gpu(inputs);
  Worst worst;
  const auto relative = [](float a, float b) { return std::abs(a - b) / (std::max(a, b) + 1e-2f); };
  for (size_t i = 0; i < inputs.size(); ++i) {
    const Input& a = inputs[i];
    const glm::vec3 n(a.n), wo(a.wo), wi(a.wi);
    const glm::vec3 f = shader::brdf_eval(brdf_of(a), n, wo, wi);
    for (int k = 0; k < 3; ++k) worst.value = std::max(worst.value, relative(f[k], outputs[i].value_pdf[k]));
    // Below the surface, where no caller uses it, the A-S density grows without bound towards -wo, and so
    // does its rounding.
    if (glm::dot(n, wi) > 0.0f)
      worst.pdf = std::max(worst.pdf, relative(brdf_pdf(brdf, n, wo, wi, false), outputs[i].value_pdf.w));
    const BrdfSample s = sample_brdf(brdf, n, wo, a.glossy_lobe.w, {a.n.w, a.wo.w}, false);
    worst.direction = std::max(worst.direction, glm::distance(s.wi, glm::vec3(outputs[i].sampled)));
  }
  return worst;
}

// Stated bounds: 1e-5 (170 roundings) times the sharpness of the lobe for value and density, relative but for
// values below 0.01; 5e-5 rad for sampled directions. Measured under llvmpipe: 3e-6, 3e-6 and 1.5e-5.
void expect_agreement(const char* backend) {
  for (const test::BrdfCase& c : test::brdf_cases()) {
    std::vector<Input> inputs;
    for (uint64_t i = 0; i < 4000; ++i) inputs.push_back(random_input(c.brdf, i));
    const Worst worst = compare(c.brdf, inputs);
    const float scale = sharpness(c.brdf);
    EXPECT_LE(worst.value, 1e-5f * scale) << c.name << ' ' << backend;
    EXPECT_LE(worst.pdf, 1e-5f * scale) << c.name << ' ' << backend;
    EXPECT_LE(worst.direction, 5e-5f) << c.name << ' ' << backend;
  }
}

// Red if the two compilations differ in more than rounding: struct layout, half packing, a macro, series
// against double logarithms (tried: the third term of the series in sample_power_cosine_angle; model bits at
// 28 in GLSL).
TEST(BrdfGlsl, AgreesWithCppOnOsmesa) {
  const auto context = gpu::Context::create("osmesa");
  expect_agreement("osmesa");
}

TEST(BrdfGlsl, AgreesWithCppOnEgl) {
  std::string reason;
  const auto context = test::egl_or_null(reason);
  if (!context) GTEST_SKIP() << reason;
  expect_agreement("egl");
}

}  // namespace
}  // namespace relight
