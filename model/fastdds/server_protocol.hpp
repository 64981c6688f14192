// Fast DDS with a Discovery Server, as a host of its rules (fsm/composition/server.hpp,
// specs/guide/discovery-server.md). Descriptors on their way to the server, and control-only
// relations, are those of `Protocol`. By source file:
//   server_protocol.cpp  events and packets to rules, clients, what a client learns
//   server_relays.cpp    the routine's lists, the sending thread, ACKNACKs to the server
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "fsm/composition/server.hpp"
#include "model/fastdds/database.hpp"
#include "model/fastdds/protocol.hpp"
#include "model/fastdds/relay.hpp"
#include "model/fastdds/relayed.hpp"

namespace stormproof::model::fastdds {

namespace server = fsm::composition::server;

/// Machines of a pair, or of a relay's relation or writer. Observers hear of the pair, or of the
/// server.
template <class Machine>
class RelayDriver {
 public:
  RelayDriver(const RunState& run, MachineRef::Kind kind, std::uint32_t stride)
      : driver_{run, kind}, stride_{stride} {}
  template <class Event>
  auto step(fsm::StateId& state, const typename Driver<Machine>::Input& input, std::uint32_t n) {
    return driver_.template step<Event>(state, input, n / stride_);
  }

 private:
  Driver<Machine> driver_;
  std::uint32_t stride_;
};

class ServerProtocol final : public Protocol {
  using Number = std::uint32_t;

 public:
  using Composition = server::FastDdsServer;

  ServerProtocol(RunState& run, Network& network);

  void handle(const Event& event) override;
  void received(const Packet& packet, Number receiver) override;
  [[nodiscard]] std::optional<Number> sender_of(const Event& event) const override;
  void count(const Packet& packet) override;
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

  // The host of a RunningWorld.
  [[nodiscard]] static WriterLayout writer_layout() { return {relay::count, relay::count}; }
  [[nodiscard]] static Number samples_of(Number) { return 0; }
  [[nodiscard]] const std::vector<Number>& readers(Number w) const {
    return relays_[w % relay::count].readers;
  }

  using Protocol::driver;
  using Protocol::state;
  auto& driver(server::RegistrationExpiry) { return pair_shots_; }
  auto& driver(server::RegistrationReply) { return pair_shots_; }
  auto& driver(server::RegistrationTimer) { return pair_initials_; }
  auto& driver(server::LearnerReply) { return relation_shots_; }
  auto& driver(server::LearnerTimer) { return relation_initials_; }
  auto& driver(server::RelayExpiry) { return writer_shots_; }
  auto& driver(server::RelayResponse) { return writer_shots_; }
  auto& driver(server::RelaySuppression) { return relation_shots_; }
  auto& driver(server::Routine) { return routine_driver_; }
  auto& driver(server::SendingThread) { return thread_driver_; }
  auto& state(server::RegistrationExpiry, Number p) { return clients_[client_of(p)].expiry; }
  auto& state(server::RegistrationReply, Number p) { return clients_[client_of(p)].reply; }
  auto& state(server::RegistrationTimer, Number p) { return clients_[client_of(p)].initial; }
  auto& state(server::LearnerReply, Number r) { return learner(r).reply; }
  auto& state(server::LearnerTimer, Number r) { return learner(r).initial; }
  auto& state(server::RelayExpiry, Number w) { return relays_[w % relay::count].expiry; }
  auto& state(server::RelayResponse, Number w) { return relays_[w % relay::count].response; }
  auto& state(server::RelaySuppression, Number r) { return about(r).suppression; }
  auto& state(server::Routine, Number) { return routine_; }
  auto& state(server::SendingThread, Number) { return thread_; }

  // Flags and numbers.
  using Protocol::assign;
  using Protocol::value;
  [[nodiscard]] bool value(server::RegistrationAcknowledged, Number p) const {
    return clients_[client_of(p)].acknowledged;
  }
  void assign(server::RegistrationAcknowledged, Number p, bool acknowledged) {
    clients_[client_of(p)].acknowledged = acknowledged;
  }
  [[nodiscard]] bool value(server::RegistrationHeartbeatSeen, Number p) const {
    return clients_[client_of(p)].heartbeat_seen;
  }
  void assign(server::RegistrationHeartbeatSeen, Number p, bool seen) {
    clients_[client_of(p)].heartbeat_seen = seen;
  }
  [[nodiscard]] std::int64_t value(server::RegistrationLastDelay, Number p) const {
    return clients_[client_of(p)].last_delay;
  }
  void assign(server::RegistrationLastDelay, Number p, std::int64_t delay) {
    lengthen(clients_[client_of(p)].last_delay, delay);
  }
  [[nodiscard]] bool value(server::LearnerOpen, Number r) { return learner(r).open; }
  void assign(server::LearnerOpen, Number r, bool open) { learner(r).open = open; }
  [[nodiscard]] bool value(server::LearnerHeartbeatSeen, Number r) {
    return learner(r).heartbeat_seen;
  }
  void assign(server::LearnerHeartbeatSeen, Number r, bool seen) {
    learner(r).heartbeat_seen = seen;
  }
  [[nodiscard]] std::int64_t value(server::LearnerLastDelay, Number r) {
    return learner(r).last_delay;
  }
  void assign(server::LearnerLastDelay, Number r, std::int64_t delay) {
    lengthen(learner(r).last_delay, delay);
  }
  [[nodiscard]] bool value(server::RelayOpen, Number r) const {
    const auto& about = relays_[r % relay::count].about;
    const auto found = about.find(r);
    return found != about.end() && found->second.open;
  }
  void assign(server::RelayOpen, Number r, bool open) {
    RelayWriter& writer = relays_[r % relay::count];
    if (std::exchange(about(r).open, open)) return;
    writer.readers.push_back(r);
    about(r).low = writer.first() - 1;
  }

  // What only the host knows.
  using Protocol::answer;
  template <class World>
  [[nodiscard]] bool answer(server::OfAnnouncements, const World& w) const {
    return relay_at(w) == relay::announcements;
  }
  template <class World>
  [[nodiscard]] bool answer(server::CrossHost, const World& w) const {
    return run_.topology.pair(w.template number<comp::owner::pair>()).cross_host;
  }
  template <class World>
  [[nodiscard]] bool answer(server::HistoryNotEmpty, const World& w) const {
    return !relays_[relay_at(w)].empty();
  }
  template <class World>
  [[nodiscard]] bool answer(server::LacksSomething, const World& w) const {
    return lacks_something(w.template number<comp::owner::relation>());
  }
  template <class World>
  [[nodiscard]] bool answer(server::SomeRequested, const World&) const {
    return some_requested_;
  }
  template <class World>
  [[nodiscard]] bool answer(server::SomeListed, const World& w) const {
    return !w.packet().relayed->numbers.empty();
  }
  template <class World>
  [[nodiscard]] bool answer(server::SomeIrrelevant, const World&) const {
    return some_irrelevant_;
  }
  template <class World>
  [[nodiscard]] bool answer(server::SomethingToSend, const World&) const {
    return !queues_.empty();
  }
  template <class World>
  [[nodiscard]] bool answer(server::SomethingUnacknowledged, const World&) const {
    return something_unacknowledged();
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::PacketsSent, const World&) const {
    return packets_sent_;
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::SendingCost, const World&) const {
    return packets_sent_ * run_.scenario.deployment.cost_to_send().count();
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::RelayHeartbeatPeriod, const World& w) const {
    return of_relay(w, server_.pdp_heartbeat_period, sedp_.heartbeat_period);
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::RelayResponseDelay, const World& w) const {
    return of_relay(w, server_.pdp_nack_response_delay, sedp_.nack_response_delay);
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::RelaySuppressionDuration, const World& w) const {
    return of_relay(w, server_.pdp_nack_suppression_duration, sedp_.nack_suppression_duration);
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::LearnerResponseDelay, const World& w) const {
    return of_relay(w, server_.pdp_heartbeat_response_delay, sedp_.heartbeat_response_delay);
  }

  // Timers: an event names the pair, or the server, and the relay.
  template <class Timer>
  void schedule(Timer, Number n, std::int64_t time) {
    constexpr bool relayed = (Timer::owner.indices & comp::owner::stream_index) != 0;
    const Number stride = relayed ? relay::count : 1;
    run_.schedule(Nanoseconds{time}, event_kind_of<Timer>, n / stride, n % stride);
  }
  void schedule(server::RoutineAgain, Number n, std::int64_t time) {
    run_.schedule(Nanoseconds{time}, event_kind_of<server::RoutineAgain>, n, routine_token_);
    routine_may_run_again_ = true;
  }
  void cancel(server::RoutineAgain, Number) {
    if (std::exchange(routine_may_run_again_, false)) ++routine_token_;
  }

  // Packets.
  using Protocol::emit;
  template <class World, class Sayings>
  void emit(server::Registration, World& w, const Sayings&) {
    send_registration(PacketKind::registration, w.template number<comp::owner::pair>(), false);
  }
  template <class World, class Sayings>
  void emit(server::RegistrationHeartbeat, World& w, const Sayings&) {
    send_registration(PacketKind::registration_heartbeat, w.template number<comp::owner::pair>(),
                      false);
  }
  template <class World, class... Sayings>
  void emit(server::RegistrationAckNack, World& w, const std::tuple<Sayings...>&) {
    send_registration(PacketKind::registration_acknack, w.template number<comp::owner::pair>(),
                      sizeof...(Sayings) > 0);
  }
  template <class World, class Sayings>
  void emit(server::RelayedData, World& w, const Sayings&) {
    send_data(w.template number<comp::owner::relation>());
  }
  template <class World, class Sayings>
  void emit(server::RelayHeartbeat, World& w, const Sayings&) {
    Relayed heartbeat;
    heartbeat.has_heartbeat = true;
    send_relayed(w.template number<comp::owner::relation>(), std::move(heartbeat));
  }
  template <class World, class... Sayings>
  void emit(server::Gap, World& w, const std::tuple<Sayings...>&) {
    Relayed gap;
    gap.has_heartbeat = sizeof...(Sayings) > 0;
    gap.numbers = irrelevant_;
    send_relayed(w.template number<comp::owner::relation>(), std::move(gap));
  }
  template <class World, class... Sayings>
  void emit(server::RelayedAckNack, World& w, const std::tuple<Sayings...>&) {
    send_acknack(w.template number<comp::owner::relation>(), sizeof...(Sayings) > 0);
  }

  // Opaque steps.
  using Protocol::perform;
  template <class World>
  void perform(server::JoinParticipants, World& w) {
    database_.join(client_of(w.template number<comp::owner::pair>()));
  }
  template <class World>
  void perform(server::OpenReaders, World& w) {
    open_readers(w.template number<comp::owner::pair>());
  }
  template <class World>
  void perform(server::OpenOwnWriter, World& w) {
    open_own_writer(w.template number<comp::owner::relation>());
  }
  template <class World>
  void perform(server::ListRelevant, World& w) {
    list_relevant(w.template number<comp::owner::relation>());
  }
  template <class World>
  void perform(server::TakeAckNack, World& w) {
    take_acknack(w.template number<comp::owner::relation>(), *w.packet().relayed);
  }
  template <class World>
  void perform(server::QueueAgain, World& w) {
    queue_again(relay_at(w));
  }
  template <class World>
  void perform(server::EndSuppression, World& w) {
    end_suppression(w.template number<comp::owner::relation>());
  }
  template <class World>
  void perform(server::UpdateDatabase, World&) {
    update_database();
  }
  template <class World>
  void perform(server::DeliverNext, World&) {
    deliver_next();
  }
  template <class World>
  void perform(server::TakeRelayed, World& w) {
    take_relayed(w.template number<comp::owner::relation>(), *w.packet().relayed);
  }
  template <class World>
  void perform(server::OpenLiveliness, World& w) {
    open_liveliness(w.template number<comp::owner::pair>());
  }

 private:
  struct Client {
    fsm::StateId expiry = fsm::Stepper<fsm::SingleShot>::initial;
    fsm::StateId reply = fsm::Stepper<fsm::SingleShot>::initial;
    fsm::StateId initial = fsm::Stepper<fsm::InitialAckNack>::initial;
    bool acknowledged = false;
    bool heartbeat_seen = false;
    std::int64_t last_delay = 0;
  };
  /// A client's reader of one relay.
  struct Learner {
    fsm::StateId reply = fsm::Stepper<fsm::SingleShot>::initial;
    fsm::StateId initial = fsm::Stepper<fsm::InitialAckNack>::initial;
    bool open = false;
    bool heartbeat_seen = false;
    std::int64_t last_delay = 0;
    std::int64_t base = 1;
    std::int64_t announced = 0;
    std::vector<bool> received;  ///< by number
  };

  [[nodiscard]] Number server_id() const { return run_.scenario.deployment.size(); }
  /// The client of a pair with the server.
  [[nodiscard]] Number client_of(Number pair) const {
    const Pair& p = run_.topology.pair(pair);
    return p.source == server_id() ? p.destination : p.source;
  }
  [[nodiscard]] Learner& learner(Number r) {
    return learners_[relay::count * client_of(r / relay::count) + r % relay::count];
  }
  [[nodiscard]] RelayWriter::Reader& about(Number r) { return relays_[r % relay::count].about[r]; }
  template <class World>
  [[nodiscard]] static Number relay_at(const World& w) {
    return w.template number<comp::owner::writer>() % relay::count;
  }
  template <class World>
  [[nodiscard]] static std::int64_t of_relay(const World& w, Nanoseconds of_announcements,
                                             Nanoseconds of_descriptors) {
    return (relay_at(w) == relay::announcements ? of_announcements : of_descriptors).count();
  }

  // server_protocol.cpp
  void begin_announcing(Number i) override;
  void take_descriptors(Number relation, const DescriptorSet& received) override;
  [[nodiscard]] bool is_notified(Number pair, Stream s, Number d) const override;
  [[nodiscard]] bool is_required(const Pair& pair, Stream s, Number d) const;
  void open_readers(Number pair);
  void open_own_writer(Number relation);
  void take_relayed(Number relation, const Relayed& relayed);
  void learn(Number client, const Relayed& relayed);
  void send_registration(PacketKind kind, Number pair, bool initial);
  void send_acknack(Number relation, bool initial);

  // server_relays.cpp
  void list_relevant(Number relation);
  void take_acknack(Number relation, const Relayed& acknack);
  void queue_again(Number relay);
  void end_suppression(Number relation);
  [[nodiscard]] bool lacks_something(Number relation) const;
  [[nodiscard]] bool something_unacknowledged() const;
  void note_acknowledgements();
  void update_database();
  void remove(Number relay, Item item);
  void insert(Number relay, Item item);
  void deliver_next();
  std::int64_t deliver(SendingQueues::Entry entry);
  bool send_gap_before(Number relation, std::int64_t number);
  void send_data(Number relation);
  [[nodiscard]] bool is_first_for(Number client, const Relayed& data);
  void send_relayed(Number relation, Relayed relayed);
  template <class Event>
  fsm::Stepper<fsm::ChangeForReader>::Output step(RelayWriter::Entry& entry, Number relation,
                                                  bool listed = false, bool below_base = false) {
    return change_driver_.template step<Event>(
        entry.state, {.listed = listed, .below_base = below_base}, relation);
  }

  const ServerProfile& server_;
  Database database_;
  std::array<RelayWriter, relay::count> relays_;
  SendingQueues queues_;
  std::vector<Client> clients_;
  std::vector<Learner> learners_;  // relay::count · client + relay
  fsm::StateId routine_ = fsm::Stepper<fsm::SingleShot>::initial;
  fsm::StateId thread_ = fsm::Stepper<fsm::EventThread>::initial;
  std::uint32_t routine_token_ = 0;
  bool routine_may_run_again_ = false;  // what has been scheduled with this token
  // Of what is being done.
  bool some_requested_ = false;
  bool some_irrelevant_ = false;
  std::vector<std::int64_t> irrelevant_;
  std::int64_t packets_sent_ = 0;
  SendingQueues::Entry served_;

  using Kind = MachineRef::Kind;
  RelayDriver<fsm::SingleShot> pair_shots_{run_, Kind::pair, 1};
  RelayDriver<fsm::InitialAckNack> pair_initials_{run_, Kind::pair, 1};
  RelayDriver<fsm::SingleShot> relation_shots_{run_, Kind::pair, relay::count};
  RelayDriver<fsm::InitialAckNack> relation_initials_{run_, Kind::pair, relay::count};
  RelayDriver<fsm::SingleShot> writer_shots_{run_, Kind::participant, relay::count};
  RelayDriver<fsm::ChangeForReader> change_driver_{run_, Kind::pair, relay::count};
  Driver<fsm::SingleShot> routine_driver_{run_, Kind::participant};
  Driver<fsm::EventThread> thread_driver_{run_, Kind::participant};
};

}  // namespace stormproof::model::fastdds
