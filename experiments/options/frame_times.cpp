#include "experiments/options/frame_times.h"

#include <charconv>
#include <cmath>

#include "experiments/usage_error.h"

namespace relight {

namespace {

constexpr int last_frame = 999999;

template <typename Number>
bool parse(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

}  // namespace

std::vector<Frame> parse_frames(const std::string& text, double fps) {
  if (!(fps > 0.0 && fps <= 1e6)) usage_fail("--fps {}: expected a number > 0 and <= 1000000", fps);
  const std::vector<std::string> parts = split(text, ':');
  int first = 0, last = 0, step = 1;
  const bool numbers = (parts.size() == 2 || parts.size() == 3) && parse<int>(parts[0], first) &&
                       parse<int>(parts[1], last) && (parts.size() == 2 || parse<int>(parts[2], step));
  if (!numbers) usage_fail("--frames '{}': expected first:last or first:last:step, e.g. 0:48:2", text);
  if (first < 0 || last < first || last > last_frame || step < 1)
    usage_fail("--frames '{}': expected 0 <= first <= last <= {} and step >= 1", text, last_frame);
  std::vector<Frame> frames;
  for (int n = first; n <= last; n += step) frames.push_back({n, n / fps});
  return frames;
}

std::vector<Frame> parse_times(const std::string& text) {
  std::vector<Frame> frames;
  for (const std::string& part : split(text, ',')) {
    double time = 0.0;
    if (!parse<double>(part, time) || !std::isfinite(time))
      usage_fail("--times '{}': expected seconds with commas between, e.g. 0,0.5,1", text);
    frames.push_back({static_cast<int>(frames.size()) + 1, time});
  }
  return frames;
}

}  // namespace relight
