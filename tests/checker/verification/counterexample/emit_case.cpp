// Prints a test file with two cases, for the build to compile: a counterexample, whose test must
// fail, and the same property in a run without the defect, whose test must pass.
#include <cstdio>

#include "checker/verification/counterexample/gtest_case.hpp"
#include "tests/checker/verification/counterexample/examples.hpp"

int main() {
  using namespace stormproof::counterexample;
  stormproof::props::Counterexample repaired = smallest();
  repaired.scenario =
      scenario_named("smallest", {"wireless.kind=constant_delay", "wireless.one_way=30us"});
  repaired.event = 0;
  const stormproof::props::Counterexample both[] = {smallest(), repaired};
  std::fputs(gtest_file(both, "tests/checker/verification/counterexample/emit_case.cpp").c_str(),
             stdout);
  return 0;
}
