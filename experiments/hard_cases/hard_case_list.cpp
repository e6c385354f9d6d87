// The list of lists: to add one, include its header and add a line here.
#include "experiments/hard_cases/hard_case_list.h"

#include "common/hard_cases/product_cases.h"
#include "experiments/usage_error.h"
#include "methods/clustered_gather/hard_cases/hard_cases.h"
#include "methods/direct_to_indirect/hard_cases/hard_cases.h"
#include "reference/hard_cases/hard_cases.h"

namespace relight {

std::vector<HardCase> all_hard_cases() {
  std::vector<HardCase> all;
  const auto add = [&](const std::string& owner, const hard::Cases& cases) {
    for (const hard::Case& c : cases) all.push_back({owner, c});
  };
  add("direct_to_indirect", direct_to_indirect::hard_cases());
  add("clustered_gather", clustered_gather::hard_cases());
  add("sparse products", hard::product_cases());
  add("reference", reference_hard_cases());
  return all;
}

std::string title(const HardCase& hard_case) { return hard_case.owner + ": " + hard_case.of.name; }

std::vector<HardCase> only(const std::vector<HardCase>& cases, const std::string& text) {
  std::vector<HardCase> chosen;
  std::string valid;
  for (const HardCase& c : cases) {
    if (title(c).find(text) != std::string::npos) chosen.push_back(c);
    valid += "\n  " + title(c);
  }
  if (chosen.empty()) usage_fail("--only '{}': no hard case's title contains it; there are:{}", text, valid);
  return chosen;
}

}  // namespace relight
