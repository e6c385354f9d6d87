// Surface materials: textured Lambert plus one glossy part (Phong, Ashikhmin-Shirley, Lafortune or GGX), and
// emission.
// Surfaces reflect on both sides with the same parameters; there is no transmission.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "common/brdf/brdf_lobes.h"

namespace relight {

// Linear RGB texels, row 0 at v = 0 (bottom, OBJ convention); wraps around in both directions.
struct Texture {
  std::string file;
  int width = 0, height = 0;
  std::vector<glm::vec3> texels;
  // Bilinear lookup at uv.
  glm::vec3 sample(const glm::vec2& uv) const;
};

struct Material {
  std::string name = "default";
  glm::vec3 diffuse{0.5f};   // Lambert albedo; multiplied by the texture if there is one
  int diffuse_texture = -1;  // index into Scene::textures, -1 for none
  // The glossy part as BrdfParams has it. As it stands here: no glossy part; with a colour and an exponent, a
  // normalised Phong lobe. Other models: set_glossy_part.
  glm::vec3 glossy{0.0f};
  float exponent = 1.0f;
  shader::BrdfShape shape{};
  glm::vec3 emission{0.0f};  // emitted radiance, both sides
  GlossyPart glossy_part() const { return {glossy, exponent, shape}; }
  void set_glossy_part(const GlossyPart& part) {
    glossy = part.glossy, exponent = part.exponent, shape = part.shape;
  }
  bool is_glossy() const { return glossy != glm::vec3(0.0f); }
};

}  // namespace relight
