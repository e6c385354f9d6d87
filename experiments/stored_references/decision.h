// Are two pictures estimates of the same one? The decision that the regression tests, `relight references
// check` and their own tests share. Each question has a p-value; together they give a false alarm with the
// stated probability.
#pragma once

#include <string>
#include <vector>

#include "experiments/stored_references/picture_statistics.h"

namespace relight {

// Probability of a false alarm for one picture, all questions together.
inline constexpr double false_alarm_level = 1e-4;

struct Question {
  std::string name;
  double p_value = 1.0;  // 0 or 1 for questions without chance
  std::string found;     // in words and numbers
};

struct Decision {
  std::vector<Question> questions;
  double level = 0.0;  // of each question; below it the pictures differ
  bool same() const;
  std::string to_string() const;  // one line a question
};

// direct     the exact direct light is the same, but for a few pixels at shadow edges, and so is its mean
// pixels     the least likely pixel and channel, corrected for their number (Sidak)
// tiles      how many 4x4 tiles differ by more than two and three standard errors (binomial tails)
// picture    the mean of all indirect light, by channel
// A sample that is not finite makes pictures differ. Throws Error if sizes differ.
Decision compare_pictures(const PictureStatistics& fresh, const PictureStatistics& stored,
                          double level = false_alarm_level);

// Difference fresh - stored of indirect light in standard errors, signed, Welch-corrected (as sigmas of a
// normal distribution): the picture to look at.
Image difference_in_sigmas(const PictureStatistics& fresh, const PictureStatistics& stored);

// Share of tiles whose mean channel differs by more than `sigmas` standard errors; 0.0027 is expected for 3.
double share_of_tiles_beyond(double sigmas, const PictureStatistics& fresh, const PictureStatistics& stored);

}  // namespace relight
