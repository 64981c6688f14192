// One or two commands for each kind of outcome.
#include "checker/verification/check/next_steps.hpp"

#include "checker/presentation/text/command_line.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/implementations.hpp"

namespace stormproof::checker {

std::vector<report::NextStep> next_steps(const std::string& words, const model::Scenario& scenario,
                                         const exact::Outlook& outlook) {
  const std::string run = report::shell_word(report::program()) + " ";
  const bool of_a_product = model::traits_of(scenario.dds).vendor.has_value();
  const report::NextStep which{run + "sensitivity " + words, "which knob moves it, and how far"};
  switch (outlook.health()) {
    case exact::Health::storm:
      if (!of_a_product) return {which};
      return {{run + "fix " + words, "what cures it: settings, ways to discover, launch plans"},
              which};
    case exact::Health::slow_link:
    case exact::Health::waiting:
      return {which};
    case exact::Health::incomplete:
      return {{run + "check " + words, "whether a rule gets stuck, with a counterexample"}};
    case exact::Health::fine:
      break;
  }
  return {{run + "fuzz " + words + " --loss 1% --start-jitter 100ms",
           "whether that lasts when packets get lost and starts differ"}};
}

std::string words_of(const std::string& scenario, const std::vector<std::string>& overrides) {
  std::string words = report::shell_word(scenario);
  for (const std::string& one : overrides) words += " --set " + report::shell_word(one);
  return words;
}

}  // namespace stormproof::checker
