// From a path of the search to one concrete run: the path is followed once more with a log of all
// difference constraints, and the earliest times that satisfy them are taken.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/engines/explorer/search.hpp"

namespace stormproof::explorer {

/// A run of the explored world; times since the start of the world.
struct ConcretePath {
  struct Step {
    Slot slot;
    model::Nanoseconds time;
    std::string state;  ///< after the step, in words
  };
  struct Packet {  ///< in the order of emission
    Slot slot;
    model::Nanoseconds emitted;
    std::optional<model::Nanoseconds> one_way;  ///< nothing: it is lost
    model::Nanoseconds leaves_after;
  };
  struct Scheduled {  ///< fired or still pending at the end
    Slot slot;
    model::Nanoseconds time;
  };
  std::vector<Step> steps;
  std::vector<Packet> packets;
  std::vector<Scheduled> scheduled;

  /// When the first event of this kind happens, or would.
  [[nodiscard]] std::optional<model::Nanoseconds> time_of(What what, unsigned relation = 0) const;
};

/// The least times of variables 0 … n-1 with time 0 for variable 0, none negative, that satisfy all
/// constraints; nothing if there are none.
[[nodiscard]] std::optional<std::vector<std::int64_t>> earliest_times(
    std::uint32_t variables, const std::vector<Constraint>& constraints);

/// One line: what happens in a step, and in which relation if there are several.
[[nodiscard]] std::string step_text(const ConcretePath::Step& step, const Scope& scope);

/// Times for the logged path.
[[nodiscard]] std::optional<ConcretePath> solve(const PathLog& log,
                                                std::vector<std::string> states);

/// The run in which `claim` breaks at the end of the path (or earlier).
template <class World>
std::optional<ConcretePath> concrete_path(World& world, const std::vector<Label>& labels,
                                          Claim claim, const Bounds& bounds) {
  PathLog log;
  Frame frame{world.scope(), world.rules()};
  frame.set_losses(world.scope().losses);
  frame.log_to(log);
  frame.keep_objection(claim);
  typename World::State state = world.start(frame);
  if (bounds.completion) frame.mark({What::opened});
  std::vector<std::string> states;
  for (const Label label : labels) {
    Search<World>::step(world, state, frame, label, bounds);
    states.push_back(world.describe(state));
  }
  return solve(log, std::move(states));
}

}  // namespace stormproof::explorer
