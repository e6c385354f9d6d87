// Light paths in Heckbert's notation, as a regular expression over vertices from the eye to the light:
//
//   E D D L        the visible surface and one more reflect diffusely
//   E (D|G)* D L   anything, but diffuse at the vertex next to the light
//   E . .* Lp      any lobes; only omni, spot and directional lights
//
//   E      the eye, first            D      diffuse reflection       G, S  glossy reflection
//   .      either (D|G)              *, +, ?, {n}, {n,}, {n,m}       how often, after a vertex or a group
//   (a|b)  either                    L      any light, last: or Lp (delta lights), La (lights with an area),
//                                           Le (environment)
// Spaces mean nothing. E L is an emitter or the environment seen directly.
//
// A pattern selects classes of path_classes.h. One that would take some paths of a class and leave others
// (for instance E D D G L: which of the two interior vertices is glossy) is refused.
#pragma once

#include <string>
#include <vector>

#include "reference/path_classes.h"

namespace relight {

// Indices of the classes that the pattern selects. Throws Error that repeats the pattern and points at the
// character, or names the class that it cuts in two.
std::vector<size_t> select_paths(const std::string& pattern, const std::vector<PathClass>& classes);

}  // namespace relight
