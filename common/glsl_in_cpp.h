// Lets a .glsl file in the common subset of GLSL 4.5 and C++ with GLM be included as C++:
//   namespace shader { using namespace glm;  #include "x.glsl" }
// The subset: no swizzles (vec3(v4) instead of v4.xyz), float literals with f, no in/out parameters,
// functions marked RL_FUNCTION, constants marked RL_CONST.
#pragma once

#include <glm/glm.hpp>

#define RL_CPP 1
#define RL_FUNCTION inline
#define RL_CONST constexpr
