// What every engine of `stormproof check` is asked, and how it answers. An engine looks at the
// properties that it can decide and is silent about the others.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/mutation.hpp"
#include "model/run_result.hpp"
#include "model/scenario.hpp"
#include "props/verdict.hpp"

namespace stormproof::smt {
class Claims;
}

namespace stormproof::checker {

/// How same-time events are ordered; anything but the first is a mistake for `mutate`.
enum class OrderRule : std::uint8_t {
  time_class_insertion,
  pairwise_prose,     ///< the paper's sentence read pair by pair; not transitive
  without_insertion,  ///< (time, class) only
  without_class       ///< (time, insertion) only
};

/// A deliberate mistake: what the checked system does, while the properties stay those of the
/// scenario.
struct Mutant {
  std::string id;
  std::string description;
  model::Mutation rules;
  std::function<void(model::Scenario&)> knobs;  ///< changes the scenario that runs; may be empty
  OrderRule order = OrderRule::time_class_insertion;
};

class FoundOfRules;

struct CheckRequest {
  const model::Scenario& scenario;  ///< the specification that properties are held against
  smt::Claims& claims;              ///< decides and exports queries; knows time-out and seed
  const Mutant* mutant = nullptr;   ///< what runs instead of the correct rules, for `mutate`
  unsigned seed = 0;
  std::uint32_t samples = 12;  ///< runs of a scenario whose schedule is drawn
  /// Called now and then with what is being done; returning false interrupts the check.
  std::function<bool(std::string_view)> on_progress;
  unsigned readers = 1;  ///< of one writer that the explorer looks at together, at most
  /// Called with each run of the scenario up to the end of discovery, in the order of the seeds.
  std::function<void(const model::Scenario&, const model::RunResult&)> on_run = {};
  unsigned effort = 1;  ///< multiplies the states that the explorer may look at
  /// What engines have found in this check that others can rest on, by name; nobody keeps it if
  /// there is none.
  std::map<std::string, props::Finding>* known = nullptr;
  /// What is found of the rules alone, for checks of other profiles (bounds/resting.hpp); nobody
  /// else needs it if there is none.
  FoundOfRules* of_rules = nullptr;
};
/// What `--thorough` makes of the effort of all searches.
inline constexpr unsigned thorough = 25;

/// Answers by property id.
using Findings = std::vector<std::pair<std::string_view, props::Finding>>;

/// The scenario that runs: the one of the request, or what the mutant makes of it.
[[nodiscard]] model::Scenario scenario_to_run(const CheckRequest& request);

}  // namespace stormproof::checker

// The engines, each in its folder:
//   checker/engines/tables/    Findings tables::check(properties, request)
//   checker/engines/timeline/  Findings timeline::check(properties, request)
//   checker/engines/calculus/  Findings calculus::check(properties, request)
//   checker/engines/explorer/  Findings explorer::check(properties, request)
//   checker/engines/exact/     Findings exact::check(properties, request)
