// A mistake on the command line (unknown name, value out of range): exit code 2. Every other Error exits
// with 1.
#pragma once

#include "common/run/error.h"

namespace relight {

class UsageError : public Error {
 public:
  using Error::Error;
};

template <typename... Args>
[[noreturn]] void usage_fail(fmt::format_string<Args...> format, Args&&... args) {
  throw UsageError(fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace relight
