// The corpus of small good and broken files.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/run/error.h"

namespace relight::testing_corpus {

inline std::string path(const std::string& name) {
  return std::string(RELIGHT_SOURCE_DIR) + "/tests/scene/corpus/" + name;
}

// Runs `action`, which must throw Error with all `parts` in its message.
template <typename Action>
void expect_error(Action action, const std::vector<std::string>& parts) {
  try {
    action();
    ADD_FAILURE() << "no error; expected one about " << parts.back();
  } catch (const Error& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << "'" << part << "' not in: " << error.what();
  }
}

}  // namespace relight::testing_corpus
