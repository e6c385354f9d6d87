#pragma once

#include <string>

#include <gtest/gtest.h>

#include "common/run/error.h"

namespace relight {

// What the Error thrown by `call` says; a failed test and "" if there is none.
template <typename Call>
std::string error_message(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no Error was thrown";
  return "";
}

}  // namespace relight
