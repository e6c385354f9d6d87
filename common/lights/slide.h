// The picture in a projector or uber-light.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace relight {

struct Slide {
  std::string file;  // for messages
  int width = 1, height = 1;
  std::vector<glm::vec4> texels{glm::vec4(1.0f)};  // linear RGB factors >= 0, row 0 on top
  uint64_t content_hash = 0;                       // of size and texels
};

}  // namespace relight
