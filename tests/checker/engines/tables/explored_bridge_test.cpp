// The bridge from the explorer to the proofs: every step that it takes on random paths, with delays
// and losses, seen by each descriptor, is a step of the system that is derived from the same rules.
// So what it packs and schedules in its own way keeps the contracts from which proofs start.
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "checker/engines/explorer/fastdds_packing.hpp"
#include "checker/engines/explorer/paper_packing.hpp"
#include "tests/checker/engines/tables/bridge.hpp"

namespace stormproof::tables {
namespace explored_bridge_test {

using explorer::Slot;
using explorer::What;

/// A path of the explored world, with what the systems know of the past.
template <class Packing, unsigned readers>
class Walk {
 public:
  using World = explorer::RelationWorld<Packing, readers>;
  using Composition = typename Packing::Composition;

  Walk(World& world, std::mt19937_64& dice)
      : world_{world}, dice_{dice}, frame_{world.scope(), world.rules()} {
    frame_.set_losses(world.scope().losses);
    frame_.log_to(log_);
    state_ = world.start(frame_);
    note_state();
  }
  [[nodiscard]] const comp::SmallState& seen() const { return seen_; }

  /// Something happens that can be next; false: nothing can. `visit(rule name, owner, place)` is
  /// called after it.
  template <class Visit>
  bool step(Visit&& visit) {
    std::vector<unsigned> next;
    for (unsigned k = 0; k < frame_.count(); ++k) {
      if (!is_mark(frame_.slot(k).what) && frame_.can_be_next(k)) next.push_back(k);
    }
    if (next.empty() || frame_.overflowed()) return false;
    const unsigned lost = frame_.losses_left() > 0 && dice_() % 8 == 0 ? 1U : 0U;
    const std::size_t emitted = log_.emissions.size();
    const std::size_t scheduled = log_.scheduled.size();
    const Slot slot = frame_.advance(next[dice_() % next.size()], lost);
    world_.fire(state_, frame_, slot);
    note_state();
    for (std::size_t k = emitted; k < log_.emissions.size(); ++k) note(log_.emissions[k].packet);
    note_timers(slot, scheduled);
    comp::Place place{0, slot.relation, 0};
    place.descriptor = slot.what == What::creation ? std::countr_zero(slot.set) : 0;
    with_rule(slot.what, [&]<class Rule>() { visit(name<Rule>(), Rule::owner, place); });
    return true;
  }

 private:
  template <class T>
  static std::string name() {
    return std::string{fsm::name_of<T>()};
  }
  template <class T, class Value>
  void note_value(Value&& value_of) {
    const bool each = (T::owner.indices & comp::owner::descriptor_index) != 0;
    constexpr unsigned count = explorer::detail::is_of_readers<T> ? readers : 1;
    for (unsigned r = 0; r < count; ++r) {
      for (unsigned d = 0; d < (each ? world_.descriptors() : 1); ++d) {
        seen_.values[{name<T>(), {0, static_cast<int>(r), static_cast<int>(d)}}] = value_of(d, r);
      }
    }
  }
  void note_state() {
    comp::for_each_type(typename Composition::Parts{}, [&]<class P>() {
      if constexpr (!explorer::detail::is_among<P>(explorer::LeftOut{})) {
        note_value<P>([&](unsigned d, unsigned r) { return state_.template state<P>(d, r); });
      }
    });
    comp::for_each_type(typename Composition::State{}, [&]<class V>() {
      if constexpr (requires { typename V::IsFlag; }) {
        note_value<V>([&](unsigned d, unsigned r) { return state_.template get<V>(r) >> d & 1; });
      }
    });
  }
  void note_timers(const Slot& due, std::size_t scheduled) {
    comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
      const auto key_of = [](const Slot& slot) {
        return comp::Key{name<T>(), {0, slot.relation, 0}};
      };
      if constexpr (T::counted) {
        seen_.pending[key_of({})] = state_.template get<T>();
      } else {
        if (explorer::what_of<T>() == due.what) seen_.surely_pending.erase(key_of(due));
        for (std::size_t k = scheduled; k < log_.scheduled.size(); ++k) {
          const Slot& started = log_.scheduled[k].slot;
          if (explorer::what_of<T>() != started.what) continue;
          seen_.surely_pending.insert(key_of(started));
          seen_.started.insert(key_of(started));
        }
      }
    });
  }
  void note(const Slot& packet) {
    if (packet.what == What::data) note_packet<typename Composition::Data>(packet);
    if (packet.what == What::heartbeat) note_packet<typename Composition::Heartbeat>(packet);
    if (packet.what == What::acknack) note_packet<typename Composition::AckNack>(packet);
  }
  template <class P>
  void note_packet(const Slot& packet) {
    comp::SentPacket sent{name<P>(), {0, packet.relation, 0}, {}};
    comp::for_each_type(typename P::Fields{}, [&]<class F>() {
      std::uint32_t& said = sent.says[name<F>()];
      if constexpr (std::derived_from<F, comp::PacketField>) {
        said = packet.has(explorer::flag_of(F{})) ? 1 : 0;
      } else if constexpr (std::is_same_v<P, comp::fastdds::Data> &&
                           std::is_same_v<F, comp::Announces>) {
        // Its HEARTBEAT would say it; it has none, and nobody reads it.
        said = state_.template get<comp::fastdds::Exists>();
      } else {
        said = explorer::members_said<F>(packet);
      }
    });
    seen_.sent.insert(sent);
  }
  template <class Visit>
  static void with_rule(What what, Visit&& visit) {
    const auto rule_for = [&]<class Trigger>() {
      visit.template operator()<comp::RuleFor<Composition, Trigger>>();
    };
    using comp::Happens;
    using comp::Received;
    comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
      if (explorer::what_of<T>() == what) rule_for.template operator()<comp::Due<T>>();
    });
    if (what == What::data) rule_for.template operator()<Received<typename Composition::Data>>();
    if (what == What::heartbeat) {
      rule_for.template operator()<Received<typename Composition::Heartbeat>>();
    }
    if (what == What::acknack) {
      rule_for.template operator()<Received<typename Composition::AckNack>>();
    }
    if (what == What::reader_opens) rule_for.template operator()<Happens<comp::ReaderOpens>>();
    if (what == What::writer_opens) {
      rule_for.template operator()<Happens<typename Packing::WriterOpens>>();
    }
    if constexpr (Packing::repairs_leave_later) {
      if (what != What::source_completion) return;
      rule_for.template operator()<comp::LeftSource<typename Composition::Data>>();
    } else {
      if (what != What::creation) return;
      rule_for.template operator()<Happens<comp::fastdds::Created>>();
    }
  }

  World& world_;
  std::mt19937_64& dice_;
  explorer::PathLog log_;
  explorer::Frame frame_;
  typename World::State state_;
  comp::SmallState seen_;
};

template <class Packing, unsigned readers = 1>
Crossing cross(const model::DdsProfile& dds, explorer::Scope scope, Unsound unsound) {
  z3::context context;
  const smt::SymbolicContext current{context};
  const DescriptorSystem derived{dds, model::Mutation{}, unsound};
  const TransitionSystem system = derived.whole();
  Bridge bridge{system};
  model::Scenario scenario;
  scenario.dds = dds;
  scope.losses = 2;
  scope.largest_delay = model::Nanoseconds{dds.sedp.heartbeat_period.count() / 4};
  scope.leaves_within = scope.largest_delay;
  scope.side_by_side = true;
  scope.readers = readers;
  explorer::RelationWorld<Packing, readers> world{scenario, scenario, scope, {}};
  std::vector<comp::Place> places;
  for (unsigned it = 0; it < world.deliveries(); ++it) {
    places.push_back({0, static_cast<int>(it / world.descriptors()),
                      static_cast<int>(it % world.descriptors())});
  }
  std::mt19937_64 dice{1};
  for (unsigned walk = 0; walk < 30; ++walk) {
    Walk<Packing, readers> path{world, dice};
    comp::SmallState state = path.seen();
    const auto look = [&](const comp::Place& place) {
      return seen_from<typename Packing::Composition>(state, place);
    };
    bridge.begin(places, look);
    for (unsigned k = 0; k < 60; ++k) {
      const bool happened =
          path.step([&](const std::string& rule, comp::Owner owner, comp::Place where) {
            state = path.seen();
            bridge.cross(rule, owner, where, look);
          });
      if (!happened || (unsound != Unsound::none && !bridge.crossing().refused.empty())) break;
    }
  }
  return bridge.crossing();
}

explorer::Scope of_descriptors(unsigned count, unsigned pushed) {
  explorer::Scope scope;
  scope.descriptors = count;
  scope.pushed = pushed;
  return scope;
}

TEST(ExploredBridge, EveryStepOfThePapersWorldIsDerived) {
  model::DdsProfile single;
  single.sedp.grouping = model::Grouping::single;
  single.sedp.initial_data = model::InitialData::pull;
  single.sedp.heartbeat_timer = model::HeartbeatTimerKind::additive;
  single.sedp.piggyback_threshold_bytes = model::Bytes{500};
  for (const model::DdsProfile& dds : {model::DdsProfile{}, single}) {
    const Crossing crossing =
        cross<explorer::PaperPacking>(dds, of_descriptors(2, 0), Unsound::none);
    EXPECT_GT(crossing.distinct, 100U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(ExploredBridge, EveryStepOfFastDdssWorldIsDerived) {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  const Crossing crossing =
      cross<explorer::FastDdsPacking>(dds, of_descriptors(9, 2), Unsound::none);
  EXPECT_GT(crossing.distinct, 100U);
  EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
}

TEST(ExploredBridge, EveryStepWithSeveralReadersIsDerived) {
  model::DdsProfile single;
  single.sedp.grouping = model::Grouping::single;
  single.sedp.piggyback_threshold_bytes = model::Bytes{500};
  Crossing crossing = cross<explorer::PaperPacking, 2>(single, of_descriptors(2, 0), Unsound::none);
  EXPECT_GT(crossing.distinct, 100U);
  EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  crossing = cross<explorer::FastDdsPacking, 2>(dds, of_descriptors(9, 2), Unsound::none);
  EXPECT_GT(crossing.distinct, 100U);
  EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
}

TEST(ExploredBridge, RefusesADerivationThatForgetsOthers) {
  EXPECT_NE(first_of(cross<explorer::PaperPacking>({}, of_descriptors(2, 0),
                                                   Unsound::packets_arrive_once)),
            "");
  const Crossing several =
      cross<explorer::PaperPacking, 2>({}, of_descriptors(2, 0), Unsound::rules_for_us_only);
  EXPECT_NE(first_of(several), "");
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  EXPECT_NE(first_of(cross<explorer::FastDdsPacking>(dds, of_descriptors(9, 2),
                                                     Unsound::rules_for_us_only)),
            "");
}

}  // namespace explored_bridge_test
}  // namespace stormproof::tables
