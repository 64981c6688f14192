// How fast the explorer steps: fired events per second of processor time, through recorded rules
// and with difference-bound matrices, on its own scopes; and beside it, if SPIN is installed, the
// states per second of SPIN on the exported composition. A state of the explorer is a zone (all
// times at once), one of SPIN has no times. The ratio is that of the two rates. Started by hand, or
// by the table of benchmarks (engine_bench.cpp); a time says more about the machine than about the
// code.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "checker/engines/explorer/plan.hpp"
#include "checker/engines/explorer/relation_world.hpp"
#include "checker/engines/explorer/search.hpp"
#include "checker/engines/promela/promela.hpp"
#include "checker/engines/promela/run_spin.hpp"

namespace {

using namespace stormproof;
using namespace stormproof::explorer;

std::uint64_t steps = 0;  ///< of all searches
double spent = 0;         ///< on them, s

void measure(const char* name, const model::Scenario& scenario, const Scope& scope) {
  Scope uncounted = scope;
  uncounted.counts_bytes = false;  // as long as no budget is used up
  RelationWorld world{scenario, scenario, uncounted, {}};
  SearchOptions options;
  options.count_generated = generated_before_heartbeat(scenario).value_or(0);
  // Everything that a search can look for in one go, and that correct rules keep.
  options.claims = bit(Claim::ack_implies_received) | bit(Claim::repair_only_if_asked) |
                   bit(Claim::snapshot) | bit(Claim::single_heartbeat) | bit(Claim::no_stall);
  options.max_states = 400'000;
  const std::clock_t start = std::clock();
  const SearchResult result = Search<RelationWorld>{world, options}.run();
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%-9s %-75s %8llu states %9llu steps %6.2f s %9.0f steps/s, depth %u%s\n", name,
              to_text(scope).c_str(), static_cast<unsigned long long>(result.states),
              static_cast<unsigned long long>(result.steps), seconds,
              static_cast<double>(result.steps) / seconds, result.depth,
              result.exhausted() ? "" : " (cut off)");
  steps += result.steps;
  spent += seconds;
}

void measure_spin(unsigned descriptors) {
  if (!promela::spin_is_available()) {
    std::puts("spin      not installed");
    return;
  }
  std::error_code error;
  const auto folder = std::filesystem::temp_directory_path(error) / "stormproof-explorer-bench";
  std::filesystem::create_directories(folder, error);
  const auto run = promela::run_spin(promela::promela_of(descriptors, {}), folder.string());
  std::filesystem::remove_all(folder, error);
  if (!run) {
    std::printf("spin      %s\n", run.error().c_str());
    return;
  }
  const double rate = static_cast<double>(run->states) / run->seconds;
  std::printf("spin      D = %u %85llu states %23.2f s %9.0f states/s; ratio %.1f\n", descriptors,
              static_cast<unsigned long long>(run->states), run->seconds, rate,
              static_cast<double>(steps) / spent / rate);
}

}  // namespace

int main() {
  model::Scenario scenario;  // the paper's timers
  const model::Nanoseconds delay{scenario.dds.sedp.heartbeat_period.count() / 4};
  for (const Scope& scope : scopes(scenario, delay)) measure("paper", scenario, scope);
  for (const Scope& scope : shared_scopes(scenario, delay, 2)) {
    measure("paper", scenario, scope);
  }
  for (const Scope& scope : shared_scopes(scenario, delay, most_readers)) {
    measure("paper", scenario, scope);
  }
  for (const Scope& scope : shared_scopes(scenario, delay, 1, most_writers)) {
    measure("paper", scenario, scope);
  }
  scenario.dds.sedp.grouping = model::Grouping::single;
  for (const Scope& scope : scopes(scenario, delay)) {
    if (scope.descriptors == 2) measure("single", scenario, scope);
  }
  scenario = {};
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  for (const Scope& scope : scopes(scenario, delay)) {
    measure("fastdds", scenario, scope);
  }
  for (const Scope& scope : shared_scopes(scenario, delay, 2)) {
    measure("fastdds", scenario, scope);
  }
  for (const Scope& scope : shared_scopes(scenario, delay, most_readers)) {
    measure("fastdds", scenario, scope);
  }
  for (const Scope& scope : shared_scopes(scenario, delay, 1, most_writers)) {
    measure("fastdds", scenario, scope);
  }
  std::printf("all       %llu steps in %.2f s: %.0f steps/s\n",
              static_cast<unsigned long long>(steps), spent, static_cast<double>(steps) / spent);
  for (const unsigned descriptors : {1U, 2U}) measure_spin(descriptors);
  return 0;
}
