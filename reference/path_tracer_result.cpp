#include "reference/path_tracer.h"

namespace relight {

Image PathTracerResult::total() const {
  Image sum = direct;
  for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += indirect.pixels[i];
  return sum;
}

}  // namespace relight
