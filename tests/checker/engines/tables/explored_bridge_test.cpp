// The bridge from the explorer to the proofs: every step that it takes on random paths, with delays
// and losses, seen by each descriptor, is a step of the system that is derived from the same rules.
// So what it packs and schedules in its own way keeps the contracts from which proofs start.
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "checker/engines/explorer/relation_world.hpp"
#include "checker/engines/explorer/slot_fields.hpp"
#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/paper.hpp"
#include "tests/checker/engines/tables/bridge.hpp"

namespace stormproof::tables {
namespace explored_bridge_test {

using comp::fastdds::FastDds;
using comp::paper::Paper;
using explorer::Slot;
using explorer::What;

/// A path of the explored world, with what the systems know of the past.
class Walk {
 public:
  using World = explorer::RelationWorld;
  using Tag = fsm::program::Tag;
  using Thing = fsm::program::Thing;

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
    const fsm::program::Rule* const rule = explorer::rule_of(world_.program(), slot.what);
    if (rule != nullptr) visit(std::string{rule->name}, rule->owner, place);
    return true;
  }

 private:
  [[nodiscard]] const Thing& thing(Tag tag) const { return world_.program().things[tag]; }
  [[nodiscard]] explorer::Kept kept(Tag tag) const { return world_.layout().of(tag); }
  [[nodiscard]] std::int64_t value_of(Tag tag, unsigned r, unsigned d) const {
    const bool each = explorer::is_of_descriptors(thing(tag));
    if (thing(tag).kind == Thing::Kind::part) return state_.at(kept(tag), r)[each ? d : 0];
    if (!each) return state_.get<std::uint8_t>(kept(tag), r);
    return state_.get<explorer::Members>(kept(tag), r) >> d & 1;
  }
  void note_values(Tag tag) {
    if (!kept(tag).is_kept()) return;
    const bool each = explorer::is_of_descriptors(thing(tag));
    const bool of_readers = (thing(tag).owner.indices & comp::owner::peer_index) != 0;
    for (unsigned r = 0; r < (of_readers ? world_.scope().readers : 1); ++r) {
      for (unsigned d = 0; d < (each ? world_.descriptors() : 1); ++d) {
        seen_
            .values[{std::string{thing(tag).name}, {0, static_cast<int>(r), static_cast<int>(d)}}] =
            value_of(tag, r, d);
      }
    }
  }
  void note_state() {
    for (const Tag part : world_.program().parts) note_values(part);
    for (const Tag tag : world_.program().state) {
      if (thing(tag).kind == Thing::Kind::flag) note_values(tag);
    }
  }
  void note_timers(const Slot& due, std::size_t scheduled) {
    for (const Tag timer : world_.program().timers) {
      const auto key_of = [&](const Slot& slot) {
        return comp::Key{std::string{thing(timer).name}, {0, slot.relation, 0}};
      };
      const auto event = explorer::what_of(thing(timer));
      if (thing(timer).counted) {
        seen_.pending[key_of({})] =
            kept(timer).is_kept() ? state_.get<std::uint8_t>(kept(timer)) : 0;
        continue;
      }
      if (event == due.what) seen_.surely_pending.erase(key_of(due));
      for (std::size_t k = scheduled; k < log_.scheduled.size(); ++k) {
        const Slot& started = log_.scheduled[k].slot;
        if (event != started.what) continue;
        seen_.surely_pending.insert(key_of(started));
        seen_.started.insert(key_of(started));
      }
    }
  }
  void note(const Slot& slot) {
    for (const Tag packet : world_.program().packets) {
      if (explorer::what_of_packet(world_.program(), packet) != slot.what) continue;
      comp::SentPacket sent{std::string{thing(packet).name}, {0, slot.relation, 0}, {}};
      for (const Tag field : thing(packet).fields) {
        sent.says[std::string{thing(field).name}] = said(field, slot);
      }
      seen_.sent.insert(sent);
    }
  }
  [[nodiscard]] std::uint32_t said(Tag tag, const Slot& packet) const {
    const explorer::SlotField& field = explorer::slot_field(thing(tag));
    if (field.as == explorer::Specialised::From::flag) return packet.has(field.flag) ? 1 : 0;
    // The HEARTBEAT of DATA would say it; it has none, and nobody reads it.
    const bool is_of_data = packet.what == What::data && field.name == "Announces";
    if (!is_of_data) return explorer::members_said(field.as, packet);
    return state_.get<explorer::Members>(kept(world_.program().find("Exists")));
  }

  World& world_;
  std::mt19937_64& dice_;
  explorer::PathLog log_;
  explorer::Frame frame_;
  World::State state_;
  comp::SmallState seen_;
};

template <class Composition>
Crossing cross(const model::DdsProfile& dds, explorer::Scope scope, Unsound unsound,
               unsigned readers = 1) {
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
  explorer::RelationWorld world{scenario, scenario, scope, {}};
  std::vector<comp::Place> places;
  for (unsigned it = 0; it < world.deliveries(); ++it) {
    places.push_back({0, static_cast<int>(it / world.descriptors()),
                      static_cast<int>(it % world.descriptors())});
  }
  std::mt19937_64 dice{1};
  for (unsigned walk = 0; walk < 30; ++walk) {
    Walk path{world, dice};
    comp::SmallState state = path.seen();
    const auto look = [&](const comp::Place& place) {
      return seen_from<Composition>(state, place);
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
    const Crossing crossing = cross<Paper>(dds, of_descriptors(2, 0), Unsound::none);
    EXPECT_GT(crossing.distinct, 100U);
    EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  }
}

TEST(ExploredBridge, EveryStepOfFastDdssWorldIsDerived) {
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  const Crossing crossing = cross<FastDds>(dds, of_descriptors(9, 2), Unsound::none);
  EXPECT_GT(crossing.distinct, 100U);
  EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
}

TEST(ExploredBridge, EveryStepWithSeveralReadersIsDerived) {
  model::DdsProfile single;
  single.sedp.grouping = model::Grouping::single;
  single.sedp.piggyback_threshold_bytes = model::Bytes{500};
  Crossing crossing = cross<Paper>(single, of_descriptors(2, 0), Unsound::none, 2);
  EXPECT_GT(crossing.distinct, 100U);
  EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  crossing = cross<FastDds>(dds, of_descriptors(9, 2), Unsound::none, 2);
  EXPECT_GT(crossing.distinct, 100U);
  EXPECT_EQ(first_of(crossing), "") << crossing.refused.size() << " of " << crossing.distinct;
}

TEST(ExploredBridge, RefusesADerivationThatForgetsOthers) {
  EXPECT_NE(first_of(cross<Paper>({}, of_descriptors(2, 0), Unsound::packets_arrive_once)), "");
  const Crossing several = cross<Paper>({}, of_descriptors(2, 0), Unsound::rules_for_us_only, 2);
  EXPECT_NE(first_of(several), "");
  model::DdsProfile dds;
  dds.implementation = model::ImplementationKind::fastdds;
  EXPECT_NE(first_of(cross<FastDds>(dds, of_descriptors(9, 2), Unsound::rules_for_us_only)), "");
}

}  // namespace explored_bridge_test
}  // namespace stormproof::tables
