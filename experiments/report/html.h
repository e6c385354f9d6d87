// Small pieces of HTML and of numbers for people.
#pragma once

#include <cstdint>
#include <string>

namespace relight::report {

std::string escaped(const std::string& text);  // & < > " '
std::string percent_text(double share);        // 0.1234 -> "12.34 %"; "not finite" for NaN
std::string seconds_text(double seconds);      // "812 ms", "3.21 s", "4 min 5 s"
std::string bytes_text(int64_t bytes);         // "12.3 MB" (1 MB = 1e6 bytes)
std::string count_text(int64_t count);         // "12 345 678", thin spaces between thousands

}  // namespace relight::report
