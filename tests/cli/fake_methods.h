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

}  // namespace relight::test
