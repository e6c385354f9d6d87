#include "experiments/report/html.h"

#include <cmath>

#include <fmt/format.h>

namespace relight::report {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string percent_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.2f}&#8239;%", 100.0 * share) : "not finite";
}

std::string seconds_text(double seconds) {
  if (!std::isfinite(seconds)) return "not finite";
  if (seconds < 1e-3) return fmt::format("{:.0f}&#8239;&micro;s", 1e6 * seconds);
  if (seconds < 1.0) return fmt::format("{:.{}f}&#8239;ms", 1e3 * seconds, seconds < 0.1 ? 1 : 0);
  if (seconds < 120.0) return fmt::format("{:.2f}&#8239;s", seconds);
  const int64_t whole = std::llround(seconds);
  return fmt::format("{}&#8239;min {}&#8239;s", whole / 60, whole % 60);
}

std::string bytes_text(int64_t bytes) {
  const double value = static_cast<double>(bytes);
  if (value < 1e6) return fmt::format("{:.1f}&#8239;kB", value * 1e-3);
  if (value < 1e9) return fmt::format("{:.1f}&#8239;MB", value * 1e-6);
  return fmt::format("{:.2f}&#8239;GB", value * 1e-9);
}

std::string count_text(int64_t count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0 && digits[i - 1] != '-') text += "&#8239;";
    text += digits[i];
  }
  return text;
}

}  // namespace relight::report
