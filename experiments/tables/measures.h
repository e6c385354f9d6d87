// What runs are compared by: three errors and three costs, each a number with the interval it is known to.
#pragma once

#include <array>
#include <limits>
#include <string>

#include "common/run/run_record.h"

namespace relight::tables {

// Nothing is known of it if value is not finite.
struct Measured {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = value, high = value;
  bool known() const;
};
// False if either is not known.
bool overlap(const Measured& a, const Measured& b);

// Shares of the picture's norm (common/image/metrics.h): all pixels, without edge pixels, indirect light
// alone.
enum class ErrorKind { relative, edges_out, indirect };
enum class CostKind { relight, memory, precompute };
inline constexpr std::array all_errors{ErrorKind::relative, ErrorKind::edges_out, ErrorKind::indirect};
inline constexpr std::array all_costs{CostKind::relight, CostKind::memory, CostKind::precompute};

const char* key(ErrorKind error);  // "relative", for addresses and files
const char* key(CostKind cost);
const char* title(ErrorKind error);  // for people
const char* title(CostKind cost);

// Interval: 95 %, due to the noise of the reference alone; never below 0.
Measured error_of(const RunRecord& record, ErrorKind error);
// What a perfect method would show because of that noise; NaN without errors.
double floor_of(const RunRecord& record, ErrorKind error);

// Median, smallest and largest repeat [ms]; not known if nothing was relit.
Measured relight_ms_of(const RunRecord& record);

// "12.5 ms", "58.2 MB", "70.5 s"; "3.27 %"; "-" if not finite.
std::string cost_text(CostKind cost, double value);
std::string error_text(double share);
// "3.27 ± 0.01 %"; the half width is left out where it would be shown as zero.
std::string error_text(const Measured& error);

}  // namespace relight::tables
