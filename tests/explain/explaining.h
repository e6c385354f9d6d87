// `explain` on the planted method, with stages that are wrong as asked.
#pragma once

#include "experiments/explain/explain.h"
#include "planted_method.h"
#include "tests/cli/program.h"

namespace relight::test {

struct Explaining {
  MethodList methods;
  ExplainOptions options;
  TemporaryFolder folder;

  explicit Explaining(const std::vector<std::string>& wrong, const std::string& broken = "") {
    methods.push_back(make_planted_method(broken));
    options.method = "planted";
    options.session.scene = "cornell";
    options.session.lights = "omni";
    options.session.view = "24x16";
    options.session.quiet = true;
    options.reference_samples = 512;
    options.pixels = 128;
    options.repeats = 1;
    options.out = folder / "out";
    for (const std::string& knob : wrong) options.settings.push_back("planted." + knob + "=wrong");
  }
  Explanation run() const { return explain(make_explain_plan(options, methods)); }
};

}  // namespace relight::test
