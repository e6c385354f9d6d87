// `relight plan`, and --tolerance of the other commands.
#include <gtest/gtest.h>

#include "common/run/effect_plan.h"
#include "plan_cases.h"
#include "tests/cli/program.h"

namespace relight::test {
namespace {

std::string plan_command(const std::string& scene, const std::string& more) {
  return "plan --scene " + effect_scene(scene) + " --lights omni --view 32x24 --quiet --no-cache --method " +
         more;
}

TEST(PlanCommand, PrintsAndWritesWhatIsDecided) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program(plan_command("plane", "direct_to_indirect --tolerance 0.5% --out " + folder / "plan.json"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* words :
       {"bounces", "rule", "bounces=0", "all surfaces lie in one plane", "tolerance 0.5 %", "by rules alone"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words << "\n" << result.out;
  const EffectPlan plan = effect_plan_from_json(read_text(folder / "plan.json"));
  EXPECT_EQ(plan.tolerance, 0.005);
  EXPECT_EQ(decision(plan, "bounces").level, "0");
}

TEST(PlanCommand, MistakesNameWhatIsValid) {
  const auto says = [](const std::string& arguments, const std::string& words) {
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  says(plan_command("plane", "direct_to_indirect --tolerance 200%"), "from 0 to below 1");
  says(plan_command("plane", "direct_to_indirect --tolerance nan"), "from 0 to below 1");
  says(plan_command("plane", "direct_to_indirect --effect bounces"), "effect=level");
  says(plan_command("plane", "direct_to_indirect --effect bounces=9"), "valid: 0, 1, 2");
  says(plan_command("plane", "direct_to_indirect --effect fog=on"),
       "valid: bounces, environment, glossy_final_gather");
  says(plan_command("plane", "direct_to_indirect --effect bounces=1 --effect bounces=2"), "before");
  const TemporaryFolder folder;
  says("compare --scene cornell --lights omni --methods clustered_gather --effect bounces=0 --out " +
           folder / "o",
       "--effect needs --tolerance");
  says("render --scene cornell --lights omni --method clustered_gather --tolerance 1% --frames 0:1 --out " +
           folder / "o.png",
       "valid with --at");
}

TEST(PlanCommand, RenderAppliesThePlan) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program("render --scene " + effect_scene("plane") +
                  " --lights omni --view 16x12 --quiet --no-cache --method direct_to_indirect --set "
                  "direct_to_indirect.device=cpu --tolerance 1% --out " +
                  folder / "a.png");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("direct light alone"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace relight::test
