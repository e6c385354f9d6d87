// Wall and CPU time of a function, and what is said of repeats.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace relight {

// `cpu`: of all threads of the process; on a machine shared with others it drifts less than `wall`, but it
// does not count threads that wait for the last one.
struct Seconds {
  double wall = 0.0, cpu = 0.0;
};

template <typename Function>
Seconds seconds_of(Function function) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  function();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC};
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The spread of ratios that single repeats would have given.
inline std::string spread(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{:.2f} .. {:.2f}", *low, *high);
}

}  // namespace relight
