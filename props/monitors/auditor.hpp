// Executes the rules of a composition beside a run: in the worlds of the simulator
// (model/engine/running_world.hpp), over plain columns. Timers, receptions and packets that leave
// their source start rules; what these do is told to the audit. Nothing here is of one composition:
// one that is new is audited as well. In layers,
//   audited_state.hpp    what is remembered, what packets say, timers
//   audited_packets.hpp  what is emitted, and the choices of contracts
//   audited_steps.hpp    opaque steps
//   audited_topics.hpp   those of control-only relations, if there are any
// and here what starts rules, also of participants that have a life.
#pragma once

#include <type_traits>
#include <vector>

#include "fsm/composition/fastdds_life.hpp"
#include "model/engine/living_host.hpp"
#include "model/life.hpp"
#include "props/monitors/audited_topics.hpp"

namespace stormproof::props {

template <class Composition, class Trigger>
inline constexpr bool has_rule = []<class... Rules>(fsm::TypeList<Rules...>) {
  return (std::is_same_v<typename Rules::Trigger, Trigger> || ...);
}(typename Composition::Rules{});

template <class Self, class Base, class Of>
using AuditedOpaque =
    std::conditional_t<model::detail::is_listed<control::ControlWriterSide>(typename Of::Things{}),
                       AuditedTopics<Self, Base, Of>, AuditedSteps<Self, Base, Of>>;

template <class Self, class Base, class Of>
class AuditedRules : public AuditedOpaque<Self, Base, Of> {
  using Steps = AuditedOpaque<Self, Base, Of>;

 public:
  using typename Steps::Columns;
  using typename Steps::Composition;
  using typename Steps::Number;
  using typename Steps::Packet;

  AuditedRules(model::RunState& run, Audit& audit)
      : Steps{run, audit},
        life_{run.scenario.deployment.life.value_or(model::Life{})},
        dying_{those_who_die(run.scenario)} {
    for (Number n = 0; has_life_ && !has_server_ && n < run.topology.relation_count(); ++n) {
      const bool left_out = run.topology.pair(n / 2).cross_host && !is_required(n / 2);
      if (left_out) run.missing -= run.topology.descriptor_count(n);
    }
  }

  void started() override {
    this->audit_.begin("Before the run");
    for (const model::StaleRelation& stale : life_.stale) open_before(stale.writer, stale.reader);
    Base::started();
    if constexpr (keeps_lives) {
      for (const model::StaleRelation& stale : life_.stale) this->forget_creations(stale.writer);
      for (const model::Restart& restart : life_.restarts) {
        if (restart.identity == model::Identity::fresh) continue;
        this->schedule(comp::Return{}, restart.participant, restart.start.count());
      }
    }
  }
  void due(const model::Event& event) override {
    if (has_life_) {
      const Number actor = model::actor_of_timer(this->self(), event).value_or(event.subject);
      if (is_away(life_, actor, this->run_.now)) return;
    }
    if (event.kind == model::EventKind::endpoint_creation) create(event);
    comp::for_each_type(typename Composition::Timers{}, [&]<class T>() {
      if (event.kind != model::event_kind_of<T>) return;
      const Number n = Columns::number(T::owner, event);
      if (this->takes(T{}, n, event)) run<comp::Due<T>>(n);
      if (std::is_same_v<T, comp::Return>) this->take_creations(event.subject);
    });
  }
  void received(const model::Packet& packet, Number receiver) override {
    if constexpr (std::is_same_v<Packet, model::Packet>) take_in(packet, receiver);
  }
  void left_source(const model::Packet& packet) override {
    comp::for_each_type(typename Composition::Packets{}, [&]<class P>() {
      if constexpr (has_rule<Composition, comp::LeftSource<P>>) {
        if (packet.kind == packet_kind_of<P>) {
          run<comp::LeftSource<P>>(packet.relation(), &packet);
        }
      }
    });
  }
  [[nodiscard]] bool follows_leaving(model::PacketKind kind) const override {
    bool follows = false;
    comp::for_each_type(typename Composition::Packets{}, [&]<class P>() {
      if constexpr (has_rule<Composition, comp::LeftSource<P>>) {
        follows = follows || kind == packet_kind_of<P>;
      }
    });
    return follows;
  }

  [[nodiscard]] bool is_required(Number pair) const override {
    const model::Pair& ends = this->topology().pair(pair);
    const auto waits_for = [&](Number i) { return !is_replaced(life_, i) && !dying_[i]; };
    return ends.cross_host && waits_for(ends.source) && waits_for(ends.destination);
  }
  /// Where who is gone is forgotten, nobody is to know who dies: of other hosts, or with a server,
  /// of any.
  using Steps::assign;
  void assign(comp::Recognised known, Number pair, bool is_known) {
    const model::Pair& ends = this->topology().pair(pair);
    if (keeps_lives && (ends.cross_host || has_server_) && dying_[ends.source] &&
        !dying_[ends.destination]) {
      this->run_.missing += is_known ? 1U : 0U;
      this->run_.missing -= this->value(known, pair) ? 1U : 0U;
    }
    Steps::assign(known, pair, is_known);
  }
  using Steps::answer;
  template <class W>
  [[nodiscard]] std::int64_t answer(comp::fastdds::AckNackNumber, const W& w) const {
    return w.packet().number_of_acknack();
  }
  template <class W>
  [[nodiscard]] std::int64_t answer(comp::LeaseDuration, const W& w) const {
    const model::Pair& ends = this->topology().pair(w.template number<comp::owner::pair>());
    if (!checks_lease(this->run_.scenario, ends.source, ends.destination)) return 0;
    return lease_of(life_, ends.source).value_or(model::Nanoseconds{}).count();
  }

 protected:
  template <class Trigger>
  void run(Number n, const Packet* packet = nullptr, Number descriptor = 0) {
    using Rule = comp::RuleFor<Composition, Trigger>;
    static constexpr std::string_view name = fsm::name_of<Rule>();
    this->audit_.begin(name);
    model::RunningWorld<Self, Rule::owner> w{this->self(), n, packet, descriptor};
    Rule::run(w);
  }
  void take_in(const Packet& packet, Number receiver) {
    comp::for_each_type(typename Composition::Packets{}, [&]<class P>() {
      if (packet.kind != packet_kind_of<P>) return;
      if (!packet.multicast()) return take<P>(packet, pair_of_packet<P>(packet));
      const model::Topology& topology = this->topology();
      for (Number n = topology.first_pair(packet.pair); n < topology.first_pair(packet.pair + 1);
           ++n) {
        const bool here = receiver == topology.pair(n).destination;
        if (here || receiver == model::Probe::everybody) take<P>(packet, n);
      }
    });
  }
  /// A packet of the pair is taken by whom it reaches.
  template <class P>
  void take(const Packet& packet, Number pair) {
    const model::Pair& ends = this->topology().pair(pair);
    const Number receiver = packet.to_writer() ? ends.source : ends.destination;
    const Number sender = packet.to_writer() ? ends.destination : ends.source;
    if (!this->has_started(receiver)) return;
    if (has_life_ &&
        !hears(this->run_.scenario.deployment, sender, receiver, packet.emitted, this->run_.now))
      return;
    if constexpr (std::is_same_v<P, lookup::LookupSample>) {
      this->take_samples(packet, [&]<class Part>(Part, const Packet& part) {
        run<comp::Received<Part>>(packet.detail, &part);
      });
    } else {
      run<comp::Received<P>>(packet.multicast() ? pair : model::number_of<P>(packet), &packet);
    }
  }
  void expect_start(Number i) override {
    this->schedule(comp::Announcement{}, i, this->topology().start(i).count());
  }
  /// Who comes back is this layer's business.
  static constexpr bool keeps_lives = model::detail::is_listed<comp::Return>(typename Of::Things{});
  const bool has_life_ = this->run_.scenario.deployment.life.has_value();
  const bool has_server_ = model::traits_of(this->run_.scenario.dds).has_server;
  const model::Life life_;
  const std::vector<bool> dying_;  // by participant

 private:
  void create(const model::Event& event) {
    if constexpr (requires { typename Composition::Created; }) {
      const std::optional<model::Endpoint> endpoint = this->created_by(event);
      if (!endpoint) return;
      const auto writer = 2 * event.subject + static_cast<Number>(endpoint->stream);
      run<comp::Happens<typename Composition::Created>>(writer, nullptr, endpoint->descriptor);
    }
  }
  /// i's writers believe that j has everything, and i has everything of j.
  void open_before([[maybe_unused]] Number i, [[maybe_unused]] Number j) {
    using Relation = model::RunningWorld<Self, comp::owner::relation>;
    if constexpr (requires(Relation & w) { Composition::was_received(w); }) {
      const Number there = this->topology().pair_between(i, j);
      const Number back = this->topology().pair(there).reverse;
      this->assign(comp::Recognised{}, back, true);
      model::RunningWorld<Self, comp::owner::pair>{this->self(), back}.call(comp::HearFrom{});
      for (Number s = 0; s < 2; ++s) {
        Relation w{this->self(), 2 * there + s};
        Composition::was_acknowledged(w);
        Relation r{this->self(), 2 * back + s};
        Composition::was_received(r);
        this->state(comp::Reader{}, 2 * back + s) =
            fsm::Reflect<fsm::DiscoveryReader>::id<fsm::discovery_reader::Complete>;
      }
      this->open_topics_before(there, back);
    }
  }
  template <class P>
  [[nodiscard]] Number pair_of_packet(const Packet& packet) const {
    if constexpr (P::owner == comp::owner::control_relation)
      return this->pair_of_control(packet.detail);
    return packet.pair;
  }
};

/// Of one composition.
template <class Composition>
class Auditor : public AuditedRules<Auditor<Composition>, Follower, Audited<Composition>> {
 public:
  using Auditor::AuditedRules::AuditedRules;
};

}  // namespace stormproof::props
