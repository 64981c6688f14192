// What spares the search work changes nothing of what it finds for two readers: that states are
// covered by others with more times, that slots are put into a common order, and that one of the
// readers is always the one whose relation opens first. Each is left out, and the outcomes
// compared.
#include <array>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "checker/engines/explorer/relation_world.hpp"
#include "model/fastdds/endpoints.hpp"
#include "tests/checker/engines/explorer/enumeration.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"

namespace stormproof::explorer {
namespace reduction_test {

using model::Nanoseconds;

/// States are the same only if all their times are; slots stay where they are; and, if wanted, the
/// writer sides open in any order.
template <class World>
class FullWorld {
 public:
  using Remembering = RememberingWorld<World>;
  struct State {
    std::uint64_t times = 0;
    typename Remembering::State inner;
    bool operator==(const State&) const = default;
  };
  FullWorld(World& world, Outcomes& outcomes, bool any_order)
      : inner_{world, outcomes}, any_order_{any_order} {}

  State start(Frame& frame) {
    if (!any_order_) return {0, inner_.start(frame)};
    Frame ordered = frame;
    const State state{0, inner_.start(ordered)};
    for (unsigned k = 0; k < ordered.count(); ++k) {
      const Slot slot = ordered.slot(k);
      // Reader sides open together, as in order.
      const unsigned first = frame.find(What::reader_opens);
      frame.schedule_between(slot, 0, scope().side_by_side ? scope().largest_delay.count() : 0);
      if (slot.what == What::reader_opens && first < frame.count() - 1) {
        frame.precede(first, frame.count() - 1);
        frame.precede(frame.count() - 1, first);
      }
    }
    return state;
  }
  void fire(State& state, Frame& frame, const Slot& slot) {
    inner_.fire(state.inner, frame, slot);
    std::vector<std::int64_t> times;
    for (unsigned i = 0; i < frame.zone().size(); ++i) {
      times.insert(times.end(), frame.zone().row(i), frame.zone().row(i) + frame.zone().size());
    }
    state.times = numbers_.try_emplace(times, numbers_.size()).first->second;
  }
  [[nodiscard]] bool complete(const State& state) const { return inner_.complete(state.inner); }
  [[nodiscard]] std::uint32_t received(const State& s) const { return inner_.received(s.inner); }
  [[nodiscard]] unsigned deliveries() const { return inner_.deliveries(); }
  [[nodiscard]] const Scope& scope() const { return inner_.scope(); }
  [[nodiscard]] const EventRules& rules() const { return inner_.rules(); }
  [[nodiscard]] static bool sorts_slots() { return false; }
  [[nodiscard]] std::size_t used_words() const { return 1 + inner_.used_words(); }

 private:
  Remembering inner_;
  bool any_order_;
  std::map<std::vector<std::int64_t>, std::uint64_t> numbers_;
};

template <class World>
Outcomes fully_explored(const model::Scenario& scenario, const Scope& scope, bool any_order) {
  World rules{scenario, scenario, scope, {}};
  Outcomes outcomes;
  FullWorld<World> world{rules, outcomes, any_order};
  SearchOptions options;
  options.mark_opening = true;
  const SearchResult result = Search<FullWorld<World>>{world, options}.run();
  EXPECT_TRUE(result.exhausted());
  return outcomes;
}

/// The history of each reader, without their names.
std::string nameless(const std::string& history) {
  std::array<std::string, 2> each;
  for (std::size_t k = 0; k < history.size();) {
    const std::size_t end = history.find(' ', k) + 1;
    std::string word = history.substr(k, end - k);
    const auto reader = static_cast<std::size_t>(word.at(1) - '0');
    each.at(reader) += word.erase(1, 1);
    k = end;
  }
  std::ranges::sort(each);
  return each[0] + "| " + each[1];
}
Outcomes nameless(const Outcomes& outcomes) {
  Outcomes result;
  for (const auto& [time, history] : outcomes.completions) {
    result.completions.insert({time, nameless(history)});
  }
  for (const std::string& history : outcomes.ends) result.ends.insert(nameless(history));
  return result;
}

model::Scenario tiny(model::ImplementationKind implementation) {
  model::Scenario scenario = tiny_scenario();
  scenario.dds.implementation = implementation;
  scenario.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  return scenario;
}
Scope two_readers(std::int64_t delay, unsigned losses, unsigned descriptors) {
  Scope scope;
  scope.readers = 2;
  scope.descriptors = descriptors;
  scope.losses = losses;
  scope.least_delay = Nanoseconds{1};
  scope.largest_delay = Nanoseconds{delay};
  return scope;
}

TEST(Reduction, CoveringAndSortingLoseNothingOfThePapersWorld) {
  const model::Scenario scenario = tiny(model::ImplementationKind::paper);
  for (const auto& [delay, losses] : {std::pair{2, 0U}, {1, 1U}}) {
    const Scope scope = two_readers(delay, losses, 1);
    const Outcomes full = fully_explored<RelationWorld>(scenario, scope, false);
    EXPECT_GT(full.ends.size(), 1U);
    EXPECT_EQ(explored<RelationWorld>(scenario, scope), full);
  }
}

TEST(Reduction, CoveringAndSortingLoseNothingOfFastDdssWorld) {
  const model::Scenario scenario = tiny(model::ImplementationKind::fastdds);
  const Scope scope = two_readers(1, 1, model::fastdds::default_publications);
  const Outcomes full = fully_explored<RelationWorld>(scenario, scope, false);
  EXPECT_GT(full.ends.size(), 1U);
  EXPECT_EQ(explored<RelationWorld>(scenario, scope), full);
}

TEST(Reduction, WhichReaderOpensFirstDoesNotMatter) {
  model::Scenario scenario = tiny(model::ImplementationKind::paper);
  scenario.dds.sedp.relation_opening = model::RelationOpening::each_side;
  Scope scope = two_readers(2, 0, 1);
  scope.side_by_side = true;
  const Outcomes full = fully_explored<RelationWorld>(scenario, scope, true);
  const Outcomes reduced = explored<RelationWorld>(scenario, scope);
  EXPECT_GT(full.ends.size(), reduced.ends.size());
  EXPECT_EQ(nameless(reduced), nameless(full));
}

}  // namespace reduction_test
}  // namespace stormproof::explorer
