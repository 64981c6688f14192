// Paths of an explored world at random, each with concrete times and as a run of the simulator,
// which has to emit what the path says.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "checker/engines/explorer/path.hpp"
#include "checker/engines/explorer/replay.hpp"
#include "checker/engines/explorer/search.hpp"

namespace stormproof::explorer {

/// How many paths could not be run, and why the first one could not.
struct Walks {
  unsigned refused = 0;
  std::string why;
};

/// `misread`: what the explored world does wrong, and runs do not.
template <class World>
Walks walk(const model::Scenario& scenario, const Scope& scope,
           const model::Mutation& misread = {}) {
  World world{scenario, scenario, scope, misread};
  std::mt19937_64 dice{1};
  std::mt19937_64 coins{1};
  Walks walks;
  for (unsigned number = 0; number < 20; ++number) {
    Frame frame{scope, world.rules()};
    frame.set_losses(scope.losses);
    typename World::State state = world.start(frame);
    std::vector<Label> path;
    while (path.size() < 40) {
      std::vector<unsigned> next;
      for (unsigned k = 0; k < frame.count(); ++k) {
        if (!is_mark(frame.slot(k).what) && frame.can_be_next(k)) next.push_back(k);
      }
      if (next.empty() || frame.overflowed()) break;
      const Label label{static_cast<std::uint8_t>(next[dice() % next.size()]),
                        std::uint8_t{frame.losses_left() > 0 && dice() % 8 == 0},
                        static_cast<std::uint8_t>(coins())};
      Search<World>::step(world, state, frame, label, {});
      path.push_back(label);
    }
    const auto concrete = concrete_path(world, path, Claim::completion, {});
    std::string why = concrete ? "" : "no concrete times";
    const ReplayRequest request{scenario, scenario, nullptr, scope, {}};
    if (concrete && scenario_of(request, *concrete, why)) continue;
    if (walks.refused++ == 0) walks.why = why;
  }
  return walks;
}

}  // namespace stormproof::explorer
