// Which pictures of an animation to make: frame numbers or times.
#pragma once

#include <string>
#include <vector>

namespace relight {

struct Frame {
  int number = 0;     // in the file's name
  double time = 0.0;  // [s]
};

// "a:b[:step]": frames a, a + step, ... up to b, at number / fps seconds; 0 <= a <= b <= 999999, step >= 1.
// Throws UsageError that shows the text found and the form expected.
std::vector<Frame> parse_frames(const std::string& text, double fps);

// "0,0.5,1": the times of frames 1, 2, 3, in seconds. Throws UsageError.
std::vector<Frame> parse_times(const std::string& text);

}  // namespace relight
