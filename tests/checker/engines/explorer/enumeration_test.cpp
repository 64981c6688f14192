// The explorer against brute force: the simulator runs every combination of integer packet delays
// and losses of a tiny instance, up to the end of all traffic, and what can come out of it must be
// what the explorer finds with its zones: no outcome more, none less. The outcomes are the pairs of
// completion time and repairs until then, and the pairs of repairs and packets in all.
#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "checker/engines/explorer/paper_packing.hpp"
#include "checker/engines/explorer/search.hpp"
#include "model/engine/packet.hpp"
#include "model/simulator.hpp"
#include "tests/checker/engines/explorer/tiny.hpp"

namespace stormproof::explorer {
namespace enumeration_test {

struct Outcomes {
  std::set<std::pair<std::int64_t, std::uint64_t>> completions;  ///< time, repairs until then
  std::set<std::pair<std::uint64_t, std::uint64_t>> ends;        ///< repairs, packets

  bool operator==(const Outcomes&) const = default;
};

/// The paper's world with counts of repairs and packets, which notes its outcomes.
template <class World>
class CountingWorld {
 public:
  static constexpr bool sorts_slots = World::sorts_slots;
  struct State {
    typename World::State paper;
    std::uint32_t repairs = 0;
    std::uint32_t packets = 0;
    bool operator==(const State&) const = default;
  };
  CountingWorld(World& world, Outcomes& outcomes) : world_{world}, outcomes_{outcomes} {}

  State start(Frame& frame) { return {world_.start(frame), 0, 0}; }
  void fire(State& state, Frame& frame, const Slot& slot) {
    const bool missing = !complete(state);
    const typename World::State before = state.paper;
    world_.fire(state.paper, frame, slot);
    state.packets += frame.emitted();
    for (unsigned d = 0; d < world_.descriptors(); ++d) {
      const bool queued = slot.what == What::repair_generation;
      if (queued && view_of(state.paper, d, slot) != view_of(before, d, slot)) ++state.repairs;
    }
    if (missing && complete(state)) {
      const unsigned mark = frame.find(What::opened) + 1;
      for (auto t = -frame.zone().bound(mark, 0); t <= frame.zone().bound(0, mark); ++t) {
        outcomes_.completions.insert({t, state.repairs});
      }
      frame.erase_marks(What::opened, 0);
    }
    if (!frame.any_pending()) outcomes_.ends.insert({state.repairs, state.packets});
  }
  [[nodiscard]] bool complete(const State& state) const { return world_.complete(state.paper); }
  [[nodiscard]] std::uint32_t received(const State& s) const { return world_.received(s.paper); }
  [[nodiscard]] unsigned deliveries() const { return world_.deliveries(); }
  [[nodiscard]] const Scope& scope() const { return world_.scope(); }
  [[nodiscard]] const EventRules& rules() const { return world_.rules(); }

 private:
  static fsm::StateId view_of(const typename World::State& state, unsigned d, const Slot& slot) {
    return state.template state<typename World::C>(d, slot.reader);
  }

  World& world_;
  Outcomes& outcomes_;
};

template <class World>
Outcomes explored_in(const model::Scenario& scenario, const Scope& scope) {
  World paper{scenario, scenario, scope, {}};
  Outcomes outcomes;
  CountingWorld<World> world{paper, outcomes};
  SearchOptions options;
  options.mark_opening = true;
  const SearchResult result = Search<CountingWorld<World>>{world, options}.run();
  EXPECT_TRUE(result.exhausted);
  return outcomes;
}
Outcomes explored(const model::Scenario& scenario, const Scope& scope) {
  return scope.readers == 1 ? explored_in<PaperWorld>(scenario, scope)
                            : explored_in<SharedPaperWorld>(scenario, scope);
}

class RelationPackets final : public model::Probe {
 public:
  struct Entry {
    std::uint64_t number = 0;
    bool repair = false;
  };
  std::vector<Entry> list;
  std::uint64_t repairs_at_completion = 0;

  explicit RelationPackets(unsigned readers) : readers_{readers} {}
  void event_finished(const model::Depths& depths) override {
    if (depths.missing == 0 && !complete_) repairs_at_completion = repairs_;
    complete_ = depths.missing == 0;
  }
  void emitted(const model::Packet& packet, std::uint32_t,
               std::span<const std::uint32_t>) override {
    const bool sedp = packet.kind == model::PacketKind::data ||
                      packet.kind == model::PacketKind::heartbeat ||
                      packet.kind == model::PacketKind::acknack;
    if (sedp && packet.pair < readers_ && packet.stream == model::Stream::pub) {
      for (std::uint32_t copy = 0; copy < packet.copies; ++copy) {
        list.push_back({packet.number + copy, packet.from_repair});
      }
      if (packet.from_repair) repairs_ += packet.descriptors.count();
    }
  }

 private:
  unsigned readers_;  // the first pairs go to them
  std::uint64_t repairs_ = 0;
  bool complete_ = false;
};

/// Runs every choice for every packet, one packet after the other.
class Enumeration {
 public:
  Enumeration(const model::Scenario& scenario, const Scope& scope) : scope_{scope} {
    scenario_ = scenario;
    scenario_.deployment.participants = {{model::HostId{0}, scope.descriptors, 0, {}, {}}};
    for (unsigned r = 1; r <= scope.readers; ++r) {
      scenario_.deployment.participants.push_back({model::HostId{r}, 0, 0, {}, {}});
    }
    scenario_.dds.descriptors.default_publications = 0;
    scenario_.dds.descriptors.default_subscriptions = 0;
    scenario_.wireless.one_way = model::Nanoseconds{0};
    scenario_.run_until = model::RunUntil::time_limit;
    descend(0, scope.losses);
  }
  Outcomes outcomes;
  std::uint64_t runs = 0;

 private:
  void descend(std::size_t decided, unsigned losses_left) {
    RelationPackets packets{scope_.readers};
    model::RunOptions options;
    options.probe = &packets;
    const model::RunResult result = model::simulate(scenario_, options);
    ++runs;
    if (packets.list.size() == decided) {
      ASSERT_TRUE(result.completed());
      // Nothing is pending between the last SEDP packet and the next announcement.
      outcomes.completions.insert({result.discovery_time->count(), packets.repairs_at_completion});
      outcomes.ends.insert({result.counts.repair_data, decided});
      return;
    }
    const RelationPackets::Entry packet = packets.list[decided];
    const std::int64_t last_leave = packet.repair ? scope_.leaves_within.count() : 0;
    for (std::int64_t leave = 0; leave <= last_leave; ++leave) {
      for (std::int64_t delay = std::max(leave, scope_.least_delay.count());
           delay <= scope_.largest_delay.count(); ++delay) {
        choose(packet.number, leave, delay, false, decided, losses_left);
      }
      if (losses_left > 0) choose(packet.number, leave, leave, true, decided, losses_left - 1);
    }
  }
  void choose(std::uint64_t number, std::int64_t leave, std::int64_t delay, bool lost,
              std::size_t decided, unsigned losses_left) {
    auto& delays = scenario_.wireless.packet_delays;
    const auto delays_before = delays;
    const auto lost_before = scenario_.wireless.lost_packets;
    delays.push_back({number, model::Nanoseconds{leave}, model::Nanoseconds{delay}});
    std::ranges::sort(delays, {}, &model::PacketDelay::packet);
    if (lost) scenario_.wireless.lost_packets.push_back(number);
    std::ranges::sort(scenario_.wireless.lost_packets);
    descend(decided + 1, losses_left);
    delays = delays_before;
    scenario_.wireless.lost_packets = lost_before;
  }

  Scope scope_;
  model::Scenario scenario_;
};

struct Case {
  const char* name;
  std::int64_t delay;
  unsigned losses;
  std::int64_t initial_acknack;
  unsigned descriptors;
  model::Grouping grouping;
  std::uint64_t least_runs;  ///< so that the test is not about next to nothing
  model::InitialAckNackInterval interval = model::InitialAckNackInterval::doubling;
  unsigned readers = 1;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class AllRuns : public testing::TestWithParam<Case> {};

TEST_P(AllRuns, OfTheSimulatorHaveTheOutcomesOfTheExplorer) {
  const Case& c = GetParam();
  model::Scenario scenario = tiny_scenario();
  scenario.dds.sedp.initial_acknack_delay = model::Nanoseconds{c.initial_acknack};
  scenario.dds.sedp.initial_acknack_interval = c.interval;
  // With `bitmap` initial ACKNACKs may go on forever after a loss.
  scenario.dds.sedp.initial_acknack = model::InitialAckNackReply::heartbeat;
  scenario.dds.sedp.grouping = c.grouping;
  Scope scope;
  scope.descriptors = c.descriptors;
  scope.losses = c.losses;
  scope.readers = c.readers;
  scope.least_delay = model::Nanoseconds{1};
  scope.largest_delay = model::Nanoseconds{c.delay};
  scope.leaves_within = model::Nanoseconds{std::min<std::int64_t>(c.delay, 1)};
  const Enumeration enumeration{scenario, scope};
  EXPECT_GT(enumeration.runs, c.least_runs);
  const Outcomes found = explored(scenario, scope);
  EXPECT_EQ(found.completions, enumeration.outcomes.completions);
  EXPECT_EQ(found.ends, enumeration.outcomes.ends);
  if (c.interval == model::InitialAckNackInterval::doubling) return;
  // The interval shows in the outcomes.
  scenario.dds.sedp.initial_acknack_interval = model::InitialAckNackInterval::doubling;
  EXPECT_NE(explored(scenario, scope).ends, enumeration.outcomes.ends);
}

INSTANTIATE_TEST_SUITE_P(
    Tiny, AllRuns,
    testing::Values(Case{"no_loss", 3, 0, 0, 1, model::Grouping::message, 200},
                    Case{"no_loss_asks_early", 3, 0, 2, 1, model::Grouping::message, 300},
                    Case{"one_loss", 2, 1, 0, 1, model::Grouping::message, 150},
                    Case{"one_loss_long_delay", 3, 1, 0, 1, model::Grouping::message, 2000},
                    Case{"one_loss_asks_early", 2, 1, 3, 1, model::Grouping::message, 200},
                    Case{"one_loss_asks_again_and_again", 2, 1, 2, 1, model::Grouping::message, 200,
                         model::InitialAckNackInterval::constant},
                    Case{"two_packets", 3, 0, 0, 2, model::Grouping::single, 100},
                    Case{"two_readers", 2, 0, 0, 1, model::Grouping::message, 100,
                         model::InitialAckNackInterval::doubling, 2},
                    Case{"two_readers_one_loss", 1, 1, 0, 1, model::Grouping::message, 10,
                         model::InitialAckNackInterval::doubling, 2}),
    [](const auto& test) { return std::string{test.param.name}; });

}  // namespace enumeration_test
}  // namespace stormproof::explorer
