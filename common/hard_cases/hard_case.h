// Hard cases: scenes, lights and data at which a method could divide by zero, lose its digits or its light.
// Each is data and a function that measures figures, each with a bound and the reason for it. One list serves
// the tests (tests/hard_cases) and the report (`relight hard-cases`), so that they cannot drift apart.
//
// Every part of the program may have a list of its own (hard_cases.h in its folder); the lists are registered
// in experiments/hard_cases/hard_case_list.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/image/image.h"

namespace relight::hard {

enum class Side { at_most, at_least };

struct Figure {
  std::string what;  // what was measured, with its unit if it has one
  double measured;
  Side side;
  double bound;
  std::string why;  // why the bound is this and no other
  // Not a number never holds.
  bool holds() const { return side == Side::at_most ? measured <= bound : measured >= bound; }
};

using Figures = std::vector<Figure>;

inline Figure at_most(std::string what, double measured, double bound, std::string why) {
  return {std::move(what), measured, Side::at_most, bound, std::move(why)};
}
// Mostly for what makes a case one: a spot that lights nothing would keep every bound.
inline Figure at_least(std::string what, double measured, double bound, std::string why) {
  return {std::move(what), measured, Side::at_least, bound, std::move(why)};
}

struct Case {
  std::string name;    // of a few words; unique in its list
  std::string breaks;  // what could break: one sentence
  // Takes seconds at most. What it throws breaks the case. The figures are the same for any number of
  // threads.
  std::function<Figures()> measure;
};

using Cases = std::vector<Case>;

// Adds the figure; of figures of the same name and bound the worst is kept (for cases of several lights,
// sizes or forms). Not a number is the worst.
void add_worst(Figures& figures, Figure figure);
void add_worst(Figures& figures, const Figures& more);

// Number of pixels of these pictures with NaN or infinity: at most 0.
Figure non_finite_pixels(const std::vector<const Image*>& images);

}  // namespace relight::hard
