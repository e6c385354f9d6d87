// Methods with a known outcome, to test the runner that compares them.
#pragma once

#include <memory>

#include "common/run/method.h"

namespace relight::test {

// Path traces with many samples: right up to its own small noise, independent of the reference's.
std::unique_ptr<Method> make_exact_method();
// `where` is "precompute" or "relight"; throws Error("broken on purpose") there.
std::unique_ptr<Method> make_throwing_method(const std::string& where);
// Black, with one NaN in the indirect and total image at pixel (3, 2).
std::unique_ptr<Method> make_nan_method();
// Black images of one pixel too little in width.
std::unique_ptr<Method> make_wrong_size_method();
// The exact image times 1.1 in indirect and direct light: a relative error of 0.1.
std::unique_ptr<Method> make_ten_percent_method();
// Black; adds its knob "size" to `sizes` with every relight.
std::unique_ptr<Method> make_listening_method(std::shared_ptr<std::vector<int64_t>> sizes);
// Black, after ten seconds in steps of 5 ms; each reports progress, or is a stage of its own.
std::unique_ptr<Method> make_slow_method(bool reports_progress);

// One method in a right and in wrong versions, all of one name, as builds of a program would have them.
enum class Version {
  right,  // the exact image; a relight takes 3 ms
  three_percent_dark,
  leaks_nan,        // one NaN in the indirect and total image at pixel (3, 2)
  ten_times_slower  // a relight takes 30 ms
};
std::unique_ptr<Method> make_version(Version version);  // named "planted"

}  // namespace relight::test
