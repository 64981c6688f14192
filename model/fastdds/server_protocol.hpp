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

/// Only the server and its pairs with clients have any of these, so there are rows for the clients
/// and for the relays. Observers and the queue hear of the pair, or of the server, and of the
/// relay.
struct ServerColumns : PlainColumns {
  using PlainColumns::column;
  static way::Elsewhere column(server::Change);  // in lists
  static way::Tokens column(server::RoutineAgain);
  static way::Capped column(server::RegistrationLastDelay);
  static way::Capped column(server::LearnerLastDelay);

  static constexpr bool is_relayed(Owner owner) {
    return (owner.indices & comp::owner::stream_index) != 0;
  }
  template <Owner owner>
  static std::uint32_t rows(const RunState& run) {
    const std::uint32_t relays = is_relayed(owner) ? relay::count : 1;
    const bool by_client = (owner.indices & comp::owner::peer_index) != 0;
    return relays * (by_client ? run.scenario.deployment.size() : 1);
  }
  static std::uint32_t row(Owner owner, std::uint32_t n, const RunState& run) {
    const std::uint32_t relays = is_relayed(owner) ? relay::count : 1;
    if ((owner.indices & comp::owner::peer_index) == 0) return n % relays;
    return relays * client_of(n / relays, run) + n % relays;
  }
  static constexpr MachineRef::Kind kind(Owner owner) {
    const bool of_pair = (owner.indices & comp::owner::peer_index) != 0;
    return of_pair ? MachineRef::Kind::pair : MachineRef::Kind::participant;
  }
  static constexpr std::uint32_t subject(Owner owner, std::uint32_t n) {
    return is_relayed(owner) ? n / relay::count : n;
  }
  static constexpr std::uint32_t detail(Owner owner, std::uint32_t n) {
    return is_relayed(owner) ? n % relay::count : 0;
  }
  static constexpr std::uint32_t number(Owner owner, const Event& event) {
    return is_relayed(owner) ? relay::count * event.subject + event.detail : event.subject;
  }
  /// The client of a pair with the server.
  static std::uint32_t client_of(std::uint32_t pair, const RunState& run) {
    const Pair& p = run.topology.pair(pair);
    return p.source == run.scenario.deployment.size() ? p.destination : p.source;
  }
};
using ServerThings = ThingsBeside<server::FastDdsServer, Protocol>;

class ServerProtocol final : public Stored<ServerProtocol, Protocol, ServerThings, ServerColumns,
                                           fsm::TypeList<server::RelayOpen>> {
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

  // What is kept, and is more than a value.
  void changed(server::RelayOpen, Number r, bool) {
    RelayWriter& writer = relays_[r % relay::count];
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
  /// A client's reader of one relay.
  struct Learner {
    std::int64_t base = 1;
    std::int64_t announced = 0;
    std::vector<bool> received;  ///< by number
  };

  [[nodiscard]] Number server_id() const { return run_.scenario.deployment.size(); }
  /// The client of a pair with the server.
  [[nodiscard]] Number client_of(Number pair) const { return ServerColumns::client_of(pair, run_); }
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
        entry.state, {.listed = listed, .below_base = below_base}, relation / relay::count);
  }

  const ServerProfile& server_;
  Database database_;
  std::array<RelayWriter, relay::count> relays_;
  SendingQueues queues_;
  std::vector<Learner> learners_;  // relay::count · client + relay
  // Of what is being done.
  bool some_requested_ = false;
  bool some_irrelevant_ = false;
  std::vector<std::int64_t> irrelevant_;
  std::int64_t packets_sent_ = 0;
  SendingQueues::Entry served_;

  Driver<fsm::ChangeForReader> change_driver_{run_, MachineRef::Kind::pair};
};

}  // namespace stormproof::model::fastdds
