// Breadth-first search over the zone states of a world: the first objection that it meets needs the
// fewest events. A world is a class with
//   State start(Frame&), fire(State&, Frame&, const Slot&), complete(State), received(State),
//   deliveries() (how many bits that has), scope(), rules(),
//   used_words() (how much of a state is used), sorts_slots() (their order says nothing),
// and knows nothing of searching; the search knows nothing of the protocol.
//
// Three claims are the search's own, because they are not about one state of the protocol:
//   no stall: from every state, paths without further loss lead to X_d = 1. Decided backwards over
//     the explored graph (checker/engines/explorer/state_graph.hpp), which must be exhausted for
//     that; a state that is stuck (nothing pending, something missing) is reported at once. What is
//     pending counts for nothing by itself: an event that leads nowhere does not prevent a stall;
//   completion: nothing is missing any more at time B;
//   quiescence: nothing is emitted later than Q after nothing is missing, if nothing is lost then.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <optional>
#include <utility>

#include "checker/engines/explorer/node_store.hpp"
#include "checker/engines/explorer/state_graph.hpp"

namespace stormproof::explorer {

struct Bounds {
  std::optional<model::Nanoseconds> completion;  ///< B, from the opening; absent: not looked for
  std::optional<model::Nanoseconds> quiescence;  ///< Q, from completion; absent: not looked for
};

struct SearchOptions {
  bool mark_opening = false;  ///< keeps the mark `opened` even if no bound refers to it
  Claims claims = 0;          ///< what is looked for; the search ends when all of it is found
  // Limits that are the same on every machine.
  std::uint64_t max_states = 1'000'000;
  std::size_t max_bytes = std::size_t{512} << 20;  ///< for states
  Bounds bounds;
  bool stop_when_complete = false;  ///< states in which nothing is missing are not expanded
  /// How far the descriptors that are put into DATA along one path are counted; 0: not at all.
  std::uint32_t count_generated = 0;
  std::function<bool()> go_on;  ///< called now and then; false ends the search
};

/// Why not all paths have been tried.
enum class CutShort : std::uint8_t {
  no,
  by_limit,        ///< of states or bytes
  by_overflow,     ///< some state has more pending events, or some step more packets, than fit
  by_interruption  ///< or everything that was asked for has been objected to
};

struct SearchResult {
  /// By claim: the path to the first objection.
  std::array<std::optional<std::vector<Label>>, claim_count> objections;
  std::uint64_t states = 0;
  std::uint64_t steps = 0;  ///< fired events
  std::uint32_t depth = 0;  ///< all paths up to this many events have been tried
  CutShort cut_short = CutShort::no;
  /// States, after all paths have been tried, of which it is open whether they stall.
  std::uint32_t undecided = 0;
  std::uint32_t most_generated = 0;      ///< along one path, as far as was to be counted
  model::Nanoseconds latest_completion;  ///< with a bound: the latest time found

  /// All paths have been tried.
  [[nodiscard]] bool exhausted() const { return cut_short == CutShort::no; }
};

template <class World>
class Search {
 public:
  using State = typename World::State;

  Search(World& world, const SearchOptions& options)
      : world_{world}, options_{options}, store_{world.used_words()} {}

  SearchResult run() {
    start();
    std::uint32_t next = 0;
    while (next < store_.size() && goes_on(next)) expand(next++);
    result_.states = store_.size();
    result_.depth = store_.depth(std::min({next, first_overflow_, store_.size() - 1}));
    if (result_.exhausted() && first_overflow_ != store_.none) {
      result_.cut_short = CutShort::by_overflow;
    }
    graph_.finish(store_.size());
    if (options_.count_generated > 0) {
      result_.most_generated = graph_.most_generated(options_.count_generated);
    }
    if (result_.exhausted()) decide_on_stalls();
    return result_;
  }

 private:
  static constexpr std::uint64_t check_interval = 1U << 10U;
  /// Packets of one step of which each may be lost: the bits of a label's mask.
  static constexpr unsigned most_lost = 8;

  [[nodiscard]] bool wants(Claim claim) const { return (wanted_ & bit(claim)) != 0; }

  /// Whether state `next` is expanded; if not, the result says why.
  bool goes_on(std::uint32_t next) {
    const bool all_found = options_.claims != 0 && wanted_ == 0;
    if (store_.size() > options_.max_states || store_.bytes() > options_.max_bytes) {
      result_.cut_short = CutShort::by_limit;
    } else if (all_found || (next % check_interval == check_interval - 1 && options_.go_on &&
                             !options_.go_on())) {
      result_.cut_short = CutShort::by_interruption;
    }
    return result_.exhausted();
  }

  void start() {
    wanted_ = options_.claims;
    Frame frame{world_.scope(), world_.rules()};
    frame.set_losses(world_.scope().losses);
    const State state = world_.start(frame);
    if (options_.bounds.completion || options_.mark_opening) frame.mark({What::opened});
    store_.add(state, frame, store_.none, {});
  }

  void expand(std::uint32_t node) {
    const State state = store_.state(node);
    if (options_.stop_when_complete && world_.complete(state)) return;
    Frame frame{world_.scope(), world_.rules()};
    store_.load(node, frame);
    const Before before{node, state, frame};
    for (unsigned k = 0; k < frame.count(); ++k) {
      if (is_mark(frame.slot(k).what) || !frame.can_be_next(k)) continue;
      unsigned choices = 0;
      do {
        const Label label{static_cast<std::uint8_t>(k), 0, static_cast<std::uint8_t>(choices)};
        choices = other_choices(choices, follow_with_losses(before, label));
      } while (choices != 0);
    }
  }

  /// The last of so many choices that can be made otherwise is, and none after it; 0: all have
  /// been.
  static unsigned other_choices(unsigned choices, unsigned count) {
    while (count > 0 && (choices >> (count - 1) & 1) != 0) choices &= ~(1U << --count);
    return count == 0 ? 0 : choices | 1U << (count - 1);
  }

  /// A state that is expanded.
  struct Before {
    std::uint32_t node;
    const State& state;
    const Frame& frame;
  };
  /// Takes one step, without and with losses; returns how many choices there were.
  unsigned follow_with_losses(const Before& before, Label label) {
    const auto [packets, choices] = follow(before, label);
    const unsigned left = before.frame.losses_left();
    const unsigned variants = left > 0 ? 1U << std::min(packets, most_lost) : 1U;
    if (left > 0 && packets > most_lost) note_overflow(before.node);
    for (unsigned mask = 1; mask < variants; ++mask) {
      if (static_cast<unsigned>(std::popcount(mask)) > left) continue;
      label.loss_mask = static_cast<std::uint8_t>(mask);
      follow(before, label);
    }
    return choices;
  }

  /// Takes one step; returns how many packets it emitted and choices it made.
  std::pair<unsigned, unsigned> follow(const Before& before, Label label) {
    ++result_.steps;
    const std::uint32_t node = before.node;
    Frame frame = before.frame;
    State state = before.state;
    step(world_, state, frame, label, options_.bounds);
    const Claims fresh = frame.objections() & wanted_;
    if (fresh != 0) note(fresh, node, label);
    if (frame.overflowed()) {
      note_overflow(node);
      return {frame.emitted(), frame.choices()};
    }
    if (options_.bounds.completion && world_.complete(state) && !world_.complete(before.state)) {
      const unsigned mark = frame.find(What::opened);
      result_.latest_completion =
          std::max(result_.latest_completion, model::Nanoseconds{frame.zone().bound(0, mark + 1)});
    }
    const auto [target, added] = store_.add(state, frame, node, label);
    if (wants(Claim::no_stall) || options_.count_generated > 0) {
      graph_.add(
          {node, target, static_cast<std::uint16_t>(frame.generated()), label.loss_mask != 0});
    }
    return {frame.emitted(), frame.choices()};
  }

 public:
  /// One event of the world, and what the search itself has to say about it. Also used to follow a
  /// path again.
  static void step(World& world, State& state, Frame& frame, Label label, const Bounds& bounds) {
    const bool missing = !world.complete(state);
    const Slot slot = frame.advance(label.slot, label.loss_mask, label.choices);
    if (bounds.completion && missing) {
      const unsigned mark = frame.find(What::opened);
      frame.object_if(Claim::completion, mark + 1, 0, -(bounds.completion->count() + 1));
    }
    world.fire(state, frame, slot);
    if (!frame.any_pending() && !world.complete(state)) frame.object(Claim::no_stall);
    if (bounds.quiescence && world.complete(state)) {
      if (missing) {
        frame.mark({What::completed});
      } else {
        watch_quiet(frame, *bounds.quiescence);
      }
    }
    if (world.sorts_slots()) frame.sort();
  }

 private:
  /// After completion: traffic that comes too late. A loss ends the claim, and so does an
  /// objection; there must be no mark left that makes each state differ from all others.
  static void watch_quiet(Frame& frame, model::Nanoseconds bound) {
    const unsigned mark = frame.find(What::completed);
    if (mark == frame.count()) return;
    const Claims before = frame.objections();
    if (frame.emitted() > 0 && !frame.lost_something()) {
      frame.object_if(Claim::quiescence, mark + 1, 0, -(bound.count() + 1));
    }
    if (frame.lost_something() || frame.objections() != before) {
      frame.erase_marks(What::completed, 0);
    }
  }

  void note(Claims claims, std::uint32_t node, Label label) {
    for (std::size_t c = 0; c < claim_count; ++c) {
      if ((claims >> c & 1) == 0) continue;
      std::vector<Label> path = path_to(node);
      path.push_back(label);
      result_.objections[c] = std::move(path);
    }
    wanted_ = static_cast<Claims>(wanted_ & ~claims);
  }

  [[nodiscard]] std::vector<Label> path_to(std::uint32_t node) const {
    std::vector<Label> path;
    for (; store_.parent(node) != store_.none; node = store_.parent(node)) {
      path.insert(path.begin(), store_.label(node));
    }
    return path;
  }

  /// Not all steps from `node` have been taken as far as they go.
  void note_overflow(std::uint32_t node) { first_overflow_ = std::min(first_overflow_, node); }

  void decide_on_stalls() {
    for (unsigned d = 0; d < world_.deliveries() && wants(Claim::no_stall); ++d) {
      const auto received = [&](std::uint32_t node) {
        return (world_.received(store_.state(node)) >> d & 1) != 0;
      };
      const std::uint32_t open = graph_.count_not_bound_to_reach(received);
      if (open == 0) continue;
      if (const auto stuck = graph_.first_that_cannot_reach(received)) {
        note_node(Claim::no_stall, *stuck);
      }
      result_.undecided = std::max(result_.undecided, open);
    }
  }

  void note_node(Claim claim, std::uint32_t node) {
    result_.objections[static_cast<std::size_t>(claim)] = path_to(node);
    wanted_ = static_cast<Claims>(wanted_ & ~bit(claim));
  }

  World& world_;
  const SearchOptions& options_;
  NodeStore<State> store_;
  StateGraph graph_;
  SearchResult result_;
  Claims wanted_ = 0;
  std::uint32_t first_overflow_ = NodeStore<State>::none;
};

}  // namespace stormproof::explorer
