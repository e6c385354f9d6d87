#include "common/shading/non_finite_report.h"

#include "common/run/error.h"

namespace relight {
namespace {

void report(const char* counter, int64_t count, const std::string& sentence, StageLog& log) {
#ifndef NDEBUG
  fail("{}", sentence);
#endif
  log.count(counter, count);
  log.warn(sentence);
}

}  // namespace

void report_non_finite_shading(int64_t count, uint32_t first, StageLog& log) {
  report("non_finite_direct_shading", count,
         fmt::format("direct shading: {} radiances were not finite and were replaced by zero, the first at "
                     "sample {}; a light may be closer to a surface than floats can tell",
                     count, first),
         log);
}

void report_non_finite_pixels(const char* which, int64_t count, size_t first, size_t width, StageLog& log) {
  report("non_finite_reconstruction", count,
         fmt::format("reconstruction: {} pixels of the {} image were not finite and were replaced by zero, "
                     "the first at x = {}, y = {}",
                     count, which, first % width, first / width),
         log);
}

}  // namespace relight
