#include "tests/brdf/brdf_cases.h"

#include <cmath>

#include <fmt/format.h>

namespace relight::test {

shader::BrdfParams with_part(const glm::vec3& diffuse, const GlossyPart& part, float tangent) {
  shader::BrdfParams brdf{diffuse, part.exponent, part.glossy, part.shape};
  brdf.shape.tangent = tangent;
  return brdf;
}

namespace {

const glm::vec3 none(0.0f), coat(0.04f), gold(1.0f, 0.71f, 0.29f), paint(0.96f, 0.4f, 0.1f);

void add_phong(std::vector<BrdfCase>& cases) {
  for (float n : {0.0f, 1.0f, 30.0f, 1e3f, 1e5f})
    cases.push_back({fmt::format("phong n={}", n), with_part(none, phong_part(gold, n))});
  cases.push_back({"phong over paint", with_part(paint, phong_part(coat, 50.0f))});
}

void add_ashikhmin_shirley(std::vector<BrdfCase>& cases) {
  for (float n : {0.0f, 1.0f, 30.0f, 1e3f, 1e5f})
    cases.push_back(
        {fmt::format("ashikhmin_shirley n={}", n), with_part(none, ashikhmin_shirley_part(gold, n, n))});
  cases.push_back(
      {"ashikhmin_shirley 10 x 100", with_part(none, ashikhmin_shirley_part(gold, 10, 100), 0.7f)});
  cases.push_back(
      {"ashikhmin_shirley 1e5 x 10", with_part(none, ashikhmin_shirley_part(gold, 1e5f, 10), -2.0f)});
  cases.push_back(
      {"ashikhmin_shirley over paint", with_part(paint, ashikhmin_shirley_part(coat, 20, 400), 3.0f)});
}

void add_lafortune(std::vector<BrdfCase>& cases) {
  const auto add = [&](const char* name, const glm::vec3& diffuse, std::vector<LafortuneLobe> lobes,
                       float tangent) {
    cases.push_back({name, with_part(diffuse, lafortune_part(lobes), tangent)});
  };
  add("lafortune n=0", none, {{-1, -1, 1, 0, gold}}, 0.0f);
  add("lafortune n=1", none, {{-1, -1, 1, 1, gold}}, 0.0f);
  add("lafortune n=1e5", none, {{-1, -1, 1, 1e5f, gold}}, 0.0f);
  add("lafortune off-specular", none, {{-1.1f, -1.1f, 1, 20, 0.5f * gold}}, 0.0f);
  add("lafortune anisotropic", none, {{-0.9f, -0.5f, 1, 40, gold}}, 1.1f);
  add("lafortune three lobes over paint", glm::vec3(0.3f, 0.1f, 0.2f),
      {{-1, -0.8f, 1, 60, {0.3f, 0.2f, 0.1f}},
       {0.7f, 0.7f, 0.9f, 15, {0.1f, 0.2f, 0}},
       {0, 0, 1, 3, glm::vec3(0.2f)}},
      -0.4f);
}

void add_ggx(std::vector<BrdfCase>& cases) {
  for (float alpha : {1.0f, 0.3f, 0.03f, 1e-3f})
    cases.push_back({fmt::format("ggx alpha={}", alpha), with_part(none, ggx_part(gold, alpha, alpha))});
  cases.push_back({"ggx 0.05 x 0.4", with_part(none, ggx_part(gold, 0.05f, 0.4f), 0.7f)});
  cases.push_back({"ggx 1 x 1e-3", with_part(none, ggx_part(gold, 1.0f, 1e-3f), 2.5f)});
  cases.push_back({"ggx over paint", with_part(paint, ggx_part(coat, 0.1f, 0.3f), -1.0f)});
}

}  // namespace

std::vector<BrdfCase> brdf_cases() {
  std::vector<BrdfCase> cases = {{"lambert", with_part(glm::vec3(1.0f, 0.5f, 0.0f), GlossyPart{})}};
  add_phong(cases);
  add_ashikhmin_shirley(cases);
  add_lafortune(cases);
  add_ggx(cases);
  return cases;
}

glm::vec3 direction(double z, double azimuth) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - z * z));
  return glm::vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
}

std::vector<glm::vec3> eye_directions() {
  return {{0, 0, 1}, direction(0.8, 0.3), direction(0.3, 2.0), direction(0.05, -1.0), direction(1e-3, 4.0)};
}

SphereCharts charts(const shader::BrdfParams& brdf, const glm::vec3& wo) {
  const glm::vec3 n(0, 0, 1);
  const uint32_t model = shader::brdf_model(brdf.shape);
  if (model == shader::brdf_phong) return SphereCharts::around({shader::phong_mirror(n, wo)});
  const glm::mat3 frame = shader::brdf_frame(brdf.shape, n);
  if (model == shader::brdf_ggx)
    return SphereCharts::of_half_vectors(frame, wo, {brdf.exponent, brdf.shape.exponent_v});
  if (model == shader::brdf_ashikhmin_shirley)
    return SphereCharts::of_half_vectors(
        frame, wo, 1.0f / glm::sqrt(glm::vec2(brdf.exponent + 1.0f, brdf.shape.exponent_v + 1.0f)));
  std::vector<glm::vec3> axes;
  for (int lobe = 0; lobe < shader::lafortune_lobes; ++lobe)
    axes.push_back(frame * shader::lafortune_axis(brdf, lobe, shader::brdf_to_local(frame, wo)));
  return SphereCharts::around(axes);
}

}  // namespace relight::test
