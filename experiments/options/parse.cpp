#include "experiments/options/parse.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "experiments/usage_error.h"

namespace relight {

namespace {

constexpr int max_side = 16384;  // beyond it pixel indices of the 2x2 sub-pixels leave 32 bits
constexpr int max_moments = 10000;
constexpr int max_bounces = 64;  // beyond it nothing visible is left at any albedo below 0.9

std::optional<int> whole_number(const std::string& text) {
  int value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

ViewChoice parse_view(const std::string& text) {
  const size_t colon = text.find(':');
  const std::string camera = colon == std::string::npos ? "" : text.substr(0, colon);
  const std::string size = colon == std::string::npos ? text : text.substr(colon + 1);
  const size_t x = size.find('x');
  const auto width = x == std::string::npos ? std::nullopt : whole_number(size.substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : whole_number(size.substr(x + 1));
  if (!width || !height || colon == 0)
    usage_fail("--view '{}': expected WIDTHxHEIGHT in pixels, e.g. 640x480, or NAME:WIDTHxHEIGHT", text);
  if (*width < 1 || *width > max_side || *height < 1 || *height > max_side) {
    usage_fail("--view '{}': each side must lie in 1..{} pixels", text, max_side);
  }
  return {camera, *width, *height};
}

std::string to_string(const ViewChoice& view) {
  return fmt::format("{}{}{}x{}", view.camera, view.camera.empty() ? "" : ":", view.width, view.height);
}

LightsChoice parse_lights(const std::string& text) {
  const size_t at = text.rfind('@');
  if (at == std::string::npos || at == 0) return {text, {}};
  std::vector<double> numbers;
  for (size_t begin = at + 1; begin <= text.size();) {
    const size_t end = std::min(text.find(':', begin), text.size());
    const auto value = number(text.substr(begin, end - begin));
    if (!value) return {text, {}};
    numbers.push_back(*value);
    begin = end + 1;
  }
  if (numbers.size() == 1) return {text.substr(0, at), numbers};
  if (numbers.size() != 3) return {text, {}};
  const double first = numbers[0], last = numbers[1], step = numbers[2];
  if (!(step > 0.0) || !(first <= last) || !((last - first) / step < max_moments))
    usage_fail("lights '{}': expected NAME@FIRST:LAST:STEP in seconds, FIRST <= LAST, at most {} moments",
               text, max_moments);
  LightsChoice choice{text.substr(0, at), {}};
  const double slack = 1e-9 * step;  // so that 0:0.3:0.1 ends with 0.3
  for (int i = 0; first + i * step <= last + slack; ++i) choice.times.push_back(first + i * step);
  return choice;
}

std::string lights_at(const std::string& name, double time) { return fmt::format("{}@{:.12g}", name, time); }

BounceRange parse_bounces(const std::string& text, int least) {
  const size_t dots = text.find("..");
  const auto low = whole_number(text.substr(0, dots));
  const auto high = dots == std::string::npos ? low : whole_number(text.substr(dots + 2));
  if (!low || !high) usage_fail("--bounces '{}': expected a..b, e.g. 1..3, or one number", text);
  if (*low < least || *low > *high || *high > max_bounces) {
    usage_fail("--bounces '{}': expected {} <= a <= b <= {} (direct light is always there)", text, least,
               max_bounces);
  }
  return {*low, *high};
}

std::string to_string(const BounceRange& range) { return fmt::format("{}..{}", range.min, range.max); }

Estimator parse_estimator(const std::string& text) {
  if (text == "next_event") return Estimator::next_event;
  if (text == "light_vertex") return Estimator::light_vertex;
  usage_fail("unknown estimator '{}'; valid: next_event, light_vertex", text);
}

std::string to_string(Estimator estimator) {
  return estimator == Estimator::next_event ? "next_event" : "light_vertex";
}

void require_samples(const std::string& option, int samples) {
  const int min_samples = PathTracerSettings{}.batches;
  constexpr int max_samples = 1 << 24;  // stratified indices and float sums are exact up to here
  if (samples < min_samples || samples > max_samples) {
    usage_fail("{} {}: expected {} (one for each batch) to {}", option, samples, min_samples, max_samples);
  }
}

KnobSetting parse_knob_setting(const std::string& text) {
  const size_t equals = text.find('=');
  const size_t dot = text.substr(0, equals).find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 == equals ||
      equals + 1 == text.size()) {
    usage_fail("--set '{}': expected method.knob=value, e.g. direct_to_indirect.coefficients=200", text);
  }
  return {text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), text.substr(equals + 1)};
}

double parse_share(const std::string& option, const std::string& text) {
  const bool percent = !text.empty() && text.back() == '%';
  double value = 0.0;
  const char* const last = text.data() + text.size() - (percent ? 1 : 0);
  const auto [end, status] = std::from_chars(text.data(), last, value);
  const double share = percent ? 0.01 * value : value;
  if (status != std::errc() || end != last || !(share >= 0.0 && share < 1.0))
    usage_fail("{} '{}': expected a share of the picture from 0 to below 1, e.g. 1% or 0.01", option, text);
  return share;
}

std::map<std::string, std::string> parse_effects(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> effects;
  for (const std::string& text : texts) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      usage_fail("--effect '{}': expected effect=level, e.g. bounces=2", text);
    const std::string name = text.substr(0, equals);
    if (!effects.emplace(name, text.substr(equals + 1)).second)
      usage_fail("--effect '{}': '{}' was given a level before", text, name);
  }
  return effects;
}

std::vector<std::string> parse_name_list(const std::string& option, const std::string& text) {
  std::vector<std::string> names;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    names.push_back(text.substr(begin, comma - begin));
    begin = comma + 1;
    if (names.back().empty()) usage_fail("{} '{}': empty name between commas", option, text);
    if (std::count(names.begin(), names.end(), names.back()) > 1) {
      usage_fail("{} '{}': '{}' appears twice", option, text, names.back());
    }
  }
  return names;
}

void append_name(std::string& list, const std::string& name) {
  if (!list.empty()) list += ", ";
  list += name;
}

std::string shell_quoted(const std::string& text) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace relight
