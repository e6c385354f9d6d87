// One number for "as bright as before?" that pixels of rare bright paths cannot drown: the tiles are summed
// with weights, so that each counts as much as an error of brightness shows there.
#pragma once

#include <utility>

#include "experiments/stored_references/picture_statistics.h"
#include "experiments/stored_references/significance.h"

namespace relight {

double mean_channel(const glm::vec3& v);
// Variance of the mean channel: its channels share their paths, so standard deviations add.
double variance_of_mean_channel(const glm::vec3& v);

// A picture of few samples that has missed rare bright paths is both too dark and too sure of it; so neither
// picture is taken to be surer than the other one's variance predicts for its number of samples.
// (Stratification gains faster than that, which makes tests milder, not wrong.)
void floor_variances(MeasuredMean& fresh, MeasuredMean& stored, const PictureStatistics& f,
                     const PictureStatistics& s);

// Weighted means {fresh, stored} of the tiles' mean channel. A picture that is too bright by a factor differs
// by that factor times each tile's mean m; of sums of independent differences of variance v, the one with
// weights m/v is the surest of it (the matched filter). m and v are those of the stored picture averaged over
// the eight tiles around, not of the tile itself: a tile that is too dark by chance mostly has too small a
// variance too, and would get too much weight (different tiles are independent). Only a tile four times as
// noisy as those around it is weighted by its own variance.
std::pair<MeasuredMean, MeasuredMean> weighted_brightness(const PictureStatistics& fresh,
                                                          const PictureStatistics& stored);

}  // namespace relight
