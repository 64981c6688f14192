// Follows Fast DDS's composition with a life: what was before the run, who is away, who hears whom,
// which events are those of sides and participants that are no more, and what a host loses in its
// own way.
#include "fsm/composition/fastdds_life.hpp"
#include "model/engine/living_host.hpp"
#include "model/life.hpp"
#include "model/trace/event_subject.hpp"
#include "props/monitors/followed_fastdds.hpp"

namespace stormproof::props {

namespace {

class LivingFollower final : public FollowedFastDds<LivingFollower, fastdds::FastDdsLiving> {
 public:
  static constexpr bool cancels_any_timer = true;

  LivingFollower(const model::Scenario& scenario, const model::Topology& topology)
      : FollowedFastDds{scenario, topology}, life_{*with_successors(scenario.deployment).life} {
    missing_ = 0;
    for (std::uint32_t relation = 0; relation < topology.relation_count(); ++relation) {
      if (is_required(relation / 2)) missing_ += topology.descriptor_count(relation);
    }
  }

  void started() override {
    begin("Before the run");
    for (const model::StaleRelation& stale : life_.stale) open_before(stale.writer, stale.reader);
    FollowedFastDds::started();
    for (const model::StaleRelation& stale : life_.stale) creations_[stale.writer].clear();
    for (const model::Restart& restart : life_.restarts) {
      if (restart.identity == model::Identity::fresh) continue;
      expect_timer(comp::Return{}, restart.participant, restart.start, {});
    }
  }
  void due(const model::Event& event) override {
    if (is_away(life_, actor_of(event), now_)) return;
    if (event.kind == model::EventKind::endpoint_creation &&
        creations_[event.subject].erase(event.insertion()) == 0) {
      return;
    }
    FollowedFastDds::due(event);
    if (event.kind == model::EventKind::participant_start) take_creations(event.subject);
  }
  void received(const Message& message, std::uint32_t receiver,
                model::Nanoseconds emitted) override {
    if (!hears(life_, sender_of(message), receiver, emitted, now_)) return;
    FollowedFastDds::received(message, receiver, emitted);
  }

  [[nodiscard]] bool is_required(std::uint32_t pair) const {
    const model::Pair& ends = topology_.pair(pair);
    return ends.cross_host && !is_replaced(life_, ends.source) &&
           !is_replaced(life_, ends.destination);
  }
  // Of a reader side that is a new one observers are told always, of clocks and of control-only
  // relations never.
  template <class P>
  static constexpr bool is_told(P, bool is_changed) {
    using Machine = typename P::Machine;
    if (std::is_same_v<P, comp::Reader>) return true;
    if (P::owner == comp::owner::control_relation) return false;
    return is_changed &&
           (std::is_same_v<P, fastdds::C> || std::is_same_v<Machine, fsm::SingleShot>);
  }
  using FollowedFastDds::ceases;
  void ceases(fastdds::Enqueued, const Place& place) {
    std::erase_if(queues_[place.participant], [&](const Place& entry) {
      return entry.writer == place.writer && entry.descriptor == place.descriptor;
    });
  }

  using FollowedFastDds::answer;
  std::int64_t answer(comp::LeaseDuration, World& w) const {
    const std::uint32_t source = topology_.pair(w.place().pair).source;
    return lease_of(life_, source).value_or(model::Nanoseconds{}).count();
  }

  using FollowedFastDds::perform;
  void perform(fastdds::HearWriter, World& w) { hear_from(sides_.pair_of(w.place().control)); }
  void perform(fastdds::HearReader, World& w) {
    hear_from(topology_.pair(sides_.pair_of(w.place().control)).reverse);
  }
  void perform(fastdds::ForgetTopics, World& w) {
    const std::uint32_t there = w.place().pair;
    sides_.for_each(there, true, [&](std::uint32_t number, const ControlSides::Needs&) {
      World side = world_at({.control = number});
      side.renew(control::ControlWriterSide{});
    });
    const std::uint32_t back = topology_.pair(there).reverse;
    sides_.for_each(back, false, [&](std::uint32_t number, const ControlSides::Needs&) {
      World side = world_at({.control = number});
      side.renew(control::ControlReaderSide{});
      side.renew(control::ControlInitialTimer{});
      side.renew(control::ControlReply{});
      side.set(control::ControlHeartbeatSeen{}, false);
      side.cancel(control::ControlInitialAttempt{});
      side.cancel(control::ControlReplyDue{});
    });
  }
  void perform(fastdds::Life::LoseAll, World& w) {
    const std::uint32_t i = w.place().participant;
    creations_[i].clear();
    fastdds::Life::lose_participant(w);
    for (std::uint32_t pair = topology_.first_pair(i); pair < topology_.first_pair(i + 1); ++pair) {
      World back = world_at(relation_place(2 * topology_.pair(pair).reverse));
      back.call(fastdds::Life::Forget{});
    }
    for (const std::uint32_t writer : {2 * i, 2 * i + 1}) {
      World of_writer = world_at(writer_place(writer));
      fastdds::Life::lose_writer(of_writer);
    }
  }

 private:
  /// Whose event it is: readers act in their relations at the destination, writers at the source.
  [[nodiscard]] std::uint32_t actor_of(const model::Event& event) const {
    using enum model::trace::Subject;
    switch (model::trace::subject_of(event.kind)) {
      case writer:
        return event.subject / 2;
      case relation: {
        const model::Pair& ends = topology_.pair(event.subject / 2);
        return event.kind == model::EventKind::suppression_end ? ends.source : ends.destination;
      }
      case control_relation:
        return topology_.pair(sides_.pair_of(event.subject)).destination;
      case pair:
        return topology_.pair(event.subject).destination;
      default:
        return event.subject;
    }
  }
  [[nodiscard]] std::uint32_t sender_of(const Message& message) const {
    using enum model::PacketKind;
    if (message.kind == spdp_multicast) return message.pair;
    const bool of_user = message.kind == user_heartbeat || message.kind == user_acknack;
    const model::Pair& ends =
        topology_.pair(of_user ? sides_.pair_of(message.detail) : message.pair);
    const bool to_writer = message.kind == acknack || message.kind == user_acknack;
    return to_writer ? ends.destination : ends.source;
  }
  void hear_from(std::uint32_t pair) {
    World heard = world_at(relation_place(2 * pair));
    heard.call(comp::HearFrom{});
  }

  /// All endpoints of i exist, its writers believe that j has everything, and i has everything of
  /// j.
  void open_before(std::uint32_t i, std::uint32_t j) {
    const std::uint32_t there = topology_.pair_between(i, j);
    const std::uint32_t back = topology_.pair(there).reverse;
    assign<comp::Recognised>(relation_place(2 * back), 1);
    hear_from(back);
    for (std::uint32_t s = 0; s < 2; ++s) {
      World w = world_at(relation_place(2 * there + s));
      w.set_each(fastdds::Exists{}, comp::everyone);
      w.feed_each(fastdds::C{}, comp::on<fsm::change_for_reader::ReaderMatched>);
      w.feed_each(fastdds::C{}, comp::on<fsm::change_for_reader::AckNackReceived>, [](World&) {
        return fsm::ChangeForReaderIo::Input<fsm::Plain>{.listed = false, .below_base = true};
      });
      w.set(fastdds::WriterOpen{}, true);
      w.set(fastdds::SomeConfirmed{}, true);
      World r = world_at(relation_place(2 * back + s));
      r.set_each(comp::X{}, comp::everyone);
      r.set_each(fastdds::Known{}, comp::everyone);
      r.set_each(fastdds::Notified{}, comp::everyone);
      r.set(comp::HeartbeatSeen{}, true);
      state<comp::Reader>(r.place()) =
          fsm::Reflect<fsm::DiscoveryReader>::id<fsm::discovery_reader::Complete>;
    }
    sides_.for_each(there, true, [&](std::uint32_t number, const ControlSides::Needs&) {
      state<control::ControlWriterSide>({.control = number}) =
          fsm::Reflect<fsm::ControlWriter>::id<fsm::control_relation::Open>;
    });
    sides_.for_each(back, false, [&](std::uint32_t number, const ControlSides::Needs&) {
      state<control::ControlReaderSide>({.control = number}) =
          fsm::Reflect<fsm::ControlReader>::id<fsm::control_relation::Open>;
      assign<control::ControlHeartbeatSeen>({.control = number}, 1);
    });
  }

  const model::Life life_;
};

}  // namespace

std::unique_ptr<Follower> follow_life(const model::Scenario& scenario,
                                      const model::Topology& topology) {
  return std::make_unique<LivingFollower>(scenario, topology);
}

}  // namespace stormproof::props
