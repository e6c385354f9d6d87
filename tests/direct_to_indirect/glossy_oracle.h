// Lobes and glossy final-gather rows pair by pair in double precision, from the models' own papers: what
// tests compare F_g with.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/brdf/brdf_lobes.h"
#include "methods/direct_to_indirect/hard_cases/glossy_setup.h"

namespace relight::direct_to_indirect {

// A glossy part and its value in double [1/sr], by channel, for a surface of Lambert albedo kd; directions in
// the frame whose z is the normal. Isotropic.
struct LobeCase {
  std::string name;
  GlossyPart part;
  double sharpness;  // Phong exponent, or what comes close: how much the lobe magnifies float directions
};

inline std::vector<LobeCase> lobe_cases() {
  const glm::vec3 gold(0.9f, 0.6f, 0.25f);
  return {{"phong 3", phong_part(gold, 3.0f), 3},
          {"phong 1e4", phong_part(gold, 1e4f), 1e4},
          {"ashikhmin_shirley 5", ashikhmin_shirley_part(gold, 5.0f, 5.0f), 5},
          {"ashikhmin_shirley 1e4", ashikhmin_shirley_part(gold, 1e4f, 1e4f), 1e4},
          {"ggx 0.6", ggx_part(gold, 0.6f, 0.6f), 6},
          {"ggx 0.01", ggx_part(gold, 0.01f, 0.01f), 1e4}};
}

inline double lobe_value(const GlossyPart& part, const glm::dvec3& kd, int channel, const glm::dvec3& o,
                         const glm::dvec3& i) {
  constexpr double pi = std::numbers::pi;
  const auto ks = static_cast<double>(part.glossy[channel]), e = static_cast<double>(part.exponent);
  if (part.model() == BrdfModel::phong) {
    const double c = 2.0 * o.z * i.z - glm::dot(o, i);
    return c > 0.0 ? ks * (e + 2.0) / (2.0 * pi) * std::pow(c, e) : 0.0;
  }
  if (!(o.z > 0.0) || !(i.z > 0.0)) return 0.0;
  const glm::dvec3 h = glm::normalize(o + i);
  const double cosine = glm::dot(h, o);
  const double fresnel = ks + std::max(0.0, 1.0 - kd[channel] - ks) * std::pow(1.0 - cosine, 5.0);
  if (part.model() == BrdfModel::ashikhmin_shirley)
    return fresnel * (e + 1.0) / (8.0 * pi) * std::pow(h.z, e) / (cosine * std::max(o.z, i.z));
  const auto lambda = [e](double z) { return 0.5 * (std::sqrt(1.0 + e * e * (1.0 / (z * z) - 1.0)) - 1.0); };
  const double q = h.z * h.z * (1.0 + (1.0 / (h.z * h.z) - 1.0) / (e * e));
  const double d = 1.0 / (pi * e * e * q * q);
  return fresnel * d / (1.0 + lambda(o.z) + lambda(i.z)) / (4.0 * o.z * i.z);
}

// rho_g of glossy_lobe.h.
inline double rho(const GlossyPart& part, const SurfaceSample& v, const glm::dvec3& eye,
                  const glm::dvec3& wi) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(v.shading_normal));
  const glm::dvec3 t = glm::normalize(std::abs(n.x) > 0.5 ? glm::cross(n, glm::dvec3(0, 1, 0))
                                                          : glm::cross(n, glm::dvec3(1, 0, 0)));
  const glm::dvec3 b = glm::cross(n, t), wo = glm::normalize(eye - glm::dvec3(v.position));
  const auto local = [&](const glm::dvec3& w) {
    return glm::dvec3(glm::dot(t, w), glm::dot(b, w), glm::dot(n, w));
  };
  double f = 0.0;
  for (int c = 0; c < 3; ++c) f += lobe_value(part, glm::dvec3(v.diffuse), c, local(wo), local(wi));
  const glm::dvec3 ks(part.glossy);
  return f / (ks.x + ks.y + ks.z);
}

// The most that a link may carry: 1, or the Fresnel term of a mirror over its mean at normal incidence.
inline double largest_element(const GlossyPart& part, const SurfaceSample& v, const glm::dvec3& eye) {
  if (part.model() == BrdfModel::phong) return 1.0;
  const double cosine = glm::dot(glm::dvec3(v.shading_normal), glm::normalize(eye - glm::dvec3(v.position)));
  const glm::dvec3 ks(part.glossy), rise = glm::max(1.0 - glm::dvec3(v.diffuse) - ks, 0.0);
  const glm::dvec3 f = ks + rise * std::pow(1.0 - cosine, 5.0);
  return cosine > 0.0 ? (f.x + f.y + f.z) / (ks.x + ks.y + ks.z) : 0.0;
}

// F_g,ij of final_gather.h without tree, tile or packet.
inline std::vector<double> glossy_oracle_row(const GatherSetup& s, const GlossyPart& part,
                                             const SurfaceSample& v) {
  std::vector<double> row(s.cloud.samples.size(), 0.0);
  const glm::dvec3 eye(s.buffer.view.camera.eye);
  const double most = largest_element(part, v, eye);
  for (size_t j = 0; j < row.size(); ++j) {
    const SurfaceSample& g = s.cloud.samples[j];
    const glm::dvec3 w = glm::dvec3(g.position) - glm::dvec3(v.position);
    const double r2 = glm::dot(w, w);
    const double cv = glm::dot(glm::dvec3(v.shading_normal), w);
    const double cg = -glm::dot(glm::dvec3(g.geometric_normal), w);
    if (!(r2 > 0.0) || cv <= 0.0 || cg <= 0.0 || glm::dot(glm::dvec3(v.geometric_normal), w) <= 0.0) continue;
    if (!s.tracer.visible(v.position, v.geometric_normal, g.position, g.geometric_normal)) continue;
    const double area = static_cast<double>(s.cloud.area[j]);
    row[j] = std::min(most, rho(part, v, eye, w / std::sqrt(r2)) * cv * cg * area / (r2 * r2));
  }
  return row;
}

}  // namespace relight::direct_to_indirect
