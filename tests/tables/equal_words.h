// A table of limits in one line.
#pragma once

#include <cmath>
#include <string>

#include "experiments/tables/equal.h"

namespace relight::test {

// "10: only a; 100: a".
inline std::string words_of(const tables::LimitTable& table) {
  std::string text;
  for (const tables::LimitRow& row : table.rows)
    text += (text.empty() ? "" : "; ") + std::to_string(std::llround(row.limit)) + ": " + row.verdict.words();
  return text;
}

}  // namespace relight::test
