// `relight hard-cases`: runs hard cases one after the other and tells which bounds hold.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/run/provenance.h"
#include "experiments/hard_cases/hard_case_list.h"

namespace relight {

struct HardCaseOutcome {
  std::string owner, name, breaks;
  hard::Figures figures;
  std::string failure;  // what the case threw; empty if it ran through
  double seconds = 0.0;
  // A case without figures shows nothing, so it does not hold.
  bool holds() const;
};

// Never throws what a case throws.
HardCaseOutcome run_hard_case(const HardCase& hard_case);

// All of them, with progress and the time left on standard error unless `quiet`.
std::vector<HardCaseOutcome> run_hard_cases(const std::vector<HardCase>& cases, bool quiet);

int64_t broken(const std::vector<HardCaseOutcome>& outcomes);

// One line a figure: owner, case, what could break, figure, measured, bound, why, verdict.
std::string hard_cases_csv(const std::vector<HardCaseOutcome>& outcomes);
std::string hard_cases_json(const std::vector<HardCaseOutcome>& outcomes, const Provenance& provenance);
std::string hard_cases_markdown(const std::vector<HardCaseOutcome>& outcomes, const Provenance& provenance);
// One self-contained page.
std::string hard_cases_html(const std::vector<HardCaseOutcome>& outcomes, const Provenance& provenance);
// For a terminal: one line a case with its figure closest to breaking; all figures of broken ones.
std::string hard_cases_text(const std::vector<HardCaseOutcome>& outcomes);

// "<= 6e-06" and the like.
std::string bound_text(const hard::Figure& figure);
std::string number_text(double value);  // four digits
// "holds", or "broken"; of a case that threw: "broken: what it threw".
std::string verdict_text(const HardCaseOutcome& outcome);

}  // namespace relight
