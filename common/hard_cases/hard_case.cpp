#include "common/hard_cases/hard_case.h"

#include <algorithm>
#include <cmath>

#include "common/finite.h"

namespace relight::hard {

namespace {

bool worse(const Figure& a, const Figure& b) {
  if (std::isnan(a.measured) || std::isnan(b.measured)) return std::isnan(a.measured);
  return a.side == Side::at_most ? a.measured > b.measured : a.measured < b.measured;
}

}  // namespace

void add_worst(Figures& figures, Figure figure) {
  const auto same = [&](const Figure& f) {
    return f.what == figure.what && f.side == figure.side && f.bound == figure.bound;
  };
  const auto found = std::find_if(figures.begin(), figures.end(), same);
  if (found == figures.end())
    figures.push_back(std::move(figure));
  else if (worse(figure, *found))
    *found = std::move(figure);
}

void add_worst(Figures& figures, const Figures& more) {
  for (const Figure& figure : more) add_worst(figures, figure);
}

Figure non_finite_pixels(const std::vector<const Image*>& images) {
  int64_t count = 0;
  for (const Image* image : images)
    count += std::count_if(image->pixels.begin(), image->pixels.end(),
                           [](const glm::vec3& p) { return !finite(p); });
  return at_most("pixels that are not finite", static_cast<double>(count), 0.0,
                 "NaN or infinity in a picture is a failure");
}

}  // namespace relight::hard
