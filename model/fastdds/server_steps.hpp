// What the steps of Discovery Servers do (fsm/composition/server_parts.hpp), and what they are
// about: of each its database, the lists of its writers, the queues of the thread that sends, and
// what clients have heard of it. It is stated once for whoever executes the rules: the simulator,
// and the audit of its runs; both include server_relays.hpp, which has the bodies. `Host` says
//   run<Trigger>(n, packet)   the rule of a trigger, for owner n
//   learn(client, relayed) a client learns what it has been sent
//   runs_for_clients<Occasion>(relation), open_builtin(pair)   the rules of any participant
//   forget_exchange(pair)  the same, if participants have a life
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "fsm/composition/server_life.hpp"
#include "model/engine/composition_knobs.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/running_world.hpp"
#include "model/engine/writer_layout.hpp"
#include "model/fastdds/database.hpp"
#include "model/fastdds/relay.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/fastdds/server_numbers.hpp"
#include "model/servers.hpp"

namespace stormproof::model::fastdds {

namespace server = fsm::composition::server;

template <class Host>
class ServerSteps {
  using Number = std::uint32_t;

 public:
  explicit ServerSteps(RunState& run)
      : steps_of_{run},
        learners_(std::size_t{relay::count} * run.topology.server_count() *
                  run.topology.participant_count()),
        changes_{run, MachineRef::Kind::pair} {
    for (Number k = 0; k < run.topology.server_count(); ++k) servers_.push_back(begin(k));
  }

  [[nodiscard]] static WriterLayout writer_layout() { return {relay::count, relay::count}; }
  [[nodiscard]] static Number samples_of(Number) { return 0; }
  [[nodiscard]] const std::vector<Number>& readers(Number w) const { return writer(w).readers; }
  void changed(server::RelayOpen, Number r, bool open) {
    RelayWriter& relay = writer(writer_of(r));
    if (!open) {
      std::erase(relay.readers, r);
      relay.about.erase(r);
      return;
    }
    relay.readers.push_back(r);
    about(r).low = relay.first() - 1;
  }
  /// Of a reader that closes its list is gone.
  void renew(server::Change, Number) {}

  /// Runs the rule of a packet between the server and a client; false if it is another one.
  bool take_in(const Packet& packet);

  // What only the host knows.
  template <class World>
  [[nodiscard]] bool answer(server::OfAnnouncements, const World& w) const {
    return is_of_announcements(w);
  }
  template <class World>
  [[nodiscard]] bool answer(server::HistoryNotEmpty, const World& w) const {
    return !relay_at(w).empty();
  }
  template <class World>
  [[nodiscard]] bool answer(server::TellsOfServer, const World& w) const {
    const Relayed& relayed = *w.packet().relayed;
    return relayed.is_announcement &&
           relayed.participant == ends_of(w.template number<comp::owner::pair>()).source;
  }
  template <class World>
  [[nodiscard]] bool answer(server::FromServer, const World& w) const {
    return steps_of_.topology.is_server(ends_of(w.template number<comp::owner::pair>()).source);
  }
  template <class World>
  [[nodiscard]] bool answer(server::Seeks, const World& w) const {
    const Pair& ends = ends_of(w.template number<comp::owner::pair>());
    if (!steps_of_.topology.is_server(ends.source)) return false;
    const std::vector<Number> sought =
        servers_sought_by(steps_of_.scenario.deployment, ends.source);
    return std::ranges::find(sought, ends.destination) != sought.end();
  }
  template <class World>
  [[nodiscard]] bool answer(server::ToServer, const World& w) const {
    return steps_of_.topology.is_server(
        ends_of(w.template number<comp::owner::pair>()).destination);
  }
  template <class World>
  [[nodiscard]] bool answer(server::IsInDatabase, const World& w) const {
    const Pair& ends = ends_of(w.template number<comp::owner::pair>());
    return server_of(ends.source).database.is_in(ends.destination);
  }
  template <class World>
  [[nodiscard]] bool answer(server::HeartbeatIsNew, const World&) const {
    return heartbeat_is_new_;
  }
  template <class World>
  [[nodiscard]] bool answer(server::IsAhead, const World& w) const {
    return w.packet().relayed->base > relay_at(w).next;
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::RegistrationNumber, const World& w) const {
    return w.packet().number_of_acknack();
  }
  template <class World>
  [[nodiscard]] bool answer(server::LacksSomething, const World& w) const;
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
  [[nodiscard]] bool answer(server::SomethingToSend, const World& w) const {
    return !server_at(w).queues.empty();
  }
  template <class World>
  [[nodiscard]] bool answer(server::SomethingUnacknowledged, const World& w) const {
    const Server& one = server_at(w);
    return !one.database.all_noted || one.relays[relay::announcements].history.size() > 1 ||
           !one.relays[relay::publications].empty() || !one.relays[relay::subscriptions].empty();
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::PacketsSent, const World&) const {
    return packets_sent_;
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::SendingCost, const World&) const {
    return packets_sent_ * steps_of_.scenario.deployment.cost_to_send().count();
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::RelayHeartbeatPeriod, const World& w) const {
    return of_relay(w, dds().server.pdp_heartbeat_period, dds().sedp.heartbeat_period);
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::RelayResponseDelay, const World& w) const {
    return of_relay(w, dds().server.pdp_nack_response_delay, dds().sedp.nack_response_delay);
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::RelaySuppressionDuration, const World& w) const {
    return of_relay(w, dds().server.pdp_nack_suppression_duration,
                    dds().sedp.nack_suppression_duration);
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(server::LearnerResponseDelay, const World& w) const {
    return of_relay(w, dds().server.pdp_heartbeat_response_delay,
                    dds().sedp.heartbeat_response_delay);
  }

  // Opaque steps.
  template <class World>
  void perform(server::ToEachServer, World& w) {
    const Number client = ends_of(w.template number<comp::owner::pair>()).source;
    for (const Number own : servers_of(steps_of_.scenario.deployment, client)) {
      host().template run<fsm::composition::Happens<server::Announces>>(
          steps_of_.topology.pair_between(client, own));
    }
  }
  template <class World>
  void perform(server::MeetServer, World& w) {
    const auto pair = w.template number<comp::owner::pair>();
    if (!steps_of_.topology.is_server(ends_of(pair).destination)) return;  // only by a mistake
    host().template run<fsm::composition::Happens<server::Meets>>(pair);
  }
  template <class World>
  void perform(server::JoinParticipants, World& w) {
    const Pair& ends = ends_of(w.template number<comp::owner::pair>());
    server_of(ends.destination).database.join(ends.source);
  }
  template <class World>
  void perform(server::OpenReaders, World& w) {
    const auto pair = w.template number<comp::owner::pair>();
    for (const Stream s : streams) {
      host().template runs_for_clients<comp::ReaderOpens>(
          static_cast<Number>(2 * pair + index_of(s)));
    }
  }
  template <class World>
  void perform(server::OpenOwnWriter, World& w) {
    const Number pair = ends_of(w.template number<comp::owner::pair>()).reverse;
    const Number relay = w.template number<comp::owner::relation>() % relay::count;
    const Number s = relay == relay::publications ? 0 : 1;
    host().template runs_for_clients<fsm::composition::fastdds::WriterOpens>(2 * pair + s);
  }
  template <class World>
  void perform(server::OpenBuiltinSides, World& w) {
    host().open_builtin(w.template number<comp::owner::pair>());
  }
  template <class World>
  void perform(server::ListRelevant, World& w);
  template <class World>
  void perform(server::TakeAckNack, World& w);
  template <class World>
  void perform(server::QueueAgain, World& w);
  template <class World>
  void perform(server::EndSuppression, World& w) {
    const auto relation = w.template number<comp::owner::relation>();
    for (auto& [number, entry] : about(relation).list) {
      step<fsm::change_for_reader::SuppressionEnded>(entry, relation);
    }
  }
  template <class World>
  void perform(server::UpdateDatabase, World& w) {
    Server& one = server_at(w);
    note_acknowledgements(one);
    insert_all(one, one.database.update());
  }
  template <class World>
  void perform(server::UpdateWithGoodbyes, World& w);
  template <class World>
  void perform(server::DeliverNext, World& w) {
    Server& one = server_at(w);
    packets_sent_ = 0;
    while (packets_sent_ == 0 && !one.queues.empty())
      packets_sent_ = deliver(one, one.queues.take());
  }
  template <class World>
  void perform(server::TakeRelayed, World& w);
  /// What a server tells of a client that it has forgotten, and tells that, counts as new again.
  template <class World>
  void perform(server::ForgetExchange, World& w) {
    const auto pair = w.template number<comp::owner::pair>();
    const Pair& ends = ends_of(pair);
    host().forget_exchange(pair);
    if (steps_of_.topology.is_server(ends.destination))
      server_of(ends.destination).database.tell_again(ends.source);
  }
  template <class World>
  void perform(server::JoinGoodbyes, World& w) {
    const Pair& ends = ends_of(w.template number<comp::owner::pair>());
    server_of(ends.destination).database.leave(ends.source);
  }
  template <class World>
  void perform(server::ForgetRelayed, World& w) {
    learner(w.template number<comp::owner::relation>()) = {};
  }
  template <class World>
  void perform(server::ListAgain, World& w);
  template <class World>
  void perform(server::TakeNew, World& w);
  template <class World>
  void perform(server::LoseDatabase, World& w);

 protected:
  /// Servers that look for others begin to do so: `tick(pair, time)` for each.
  template <class Tick>
  void for_those_who_seek(Tick&& tick) const {
    const Topology& topology = steps_of_.topology;
    for (Number k = 0; k < topology.server_count(); ++k) {
      const Number id = topology.first_server() + k;
      for (const Number other : servers_sought_by(steps_of_.scenario.deployment, id)) {
        tick(topology.pair_between(id, other), knob_value(server::RoutinePeriod{}, dds()));
      }
    }
  }
  /// Of what the relation carries.
  [[nodiscard]] Number client_of(Number relation) const {
    return ends_of(relation / relay::count).destination;
  }
  /// A descriptor that is new to the server.
  void arrive(Number server, Number i, Stream s, Number d) {
    Database& database = server_of(server).database;
    database.arrive(database.descriptor(i, s, d));
  }

  /// Which one the server's next ACKNACK to clients is, of their announcements or of a stream.
  [[nodiscard]] Number next_acknack(Number server, Number relay) {
    return ++server_of(server).acknacks[relay];
  }
  /// Whether the relation's client is sent the descriptor for the first time by its server, which
  /// it is with this.
  [[nodiscard]] bool is_first_for(Number relation, const Relayed& data) {
    const Number client = client_of(relation);
    if (data.participant == client) return false;  // only a mistake tells it of itself
    Database& database = server_of(ends_of(relation / relay::count).source).database;
    return database.tell(database.descriptor(data.participant, data.stream, data.descriptor),
                         client);
  }

  // What packets carry.
  /// It asks for all that is missing of what is announced; an initial one claims nothing.
  [[nodiscard]] Relayed contents(server::RelayedAckNack, Number relation, bool initial) {
    return asks(relation, initial);
  }
  /// What the sending thread serves; otherwise it is the server's own announcement.
  [[nodiscard]] Relayed contents(server::RelayedData, Number relation, bool serves) {
    const Number self = ends_of(relation / relay::count).source;
    const Server& one = server_of(self);
    if (serves) return with_heartbeat(relation, data_of(one, served_));
    return data_of(one, {relay::announcements, one.database.announcement(self)});
  }
  [[nodiscard]] Relayed contents(server::RelayHeartbeat, Number relation, bool) {
    return with_heartbeat(relation, {});
  }
  [[nodiscard]] Relayed contents(server::Gap, Number relation, bool announces) {
    Relayed gap;
    gap.numbers = irrelevant_;
    return announces ? with_heartbeat(relation, std::move(gap)) : gap;
  }

 private:
  /// What one server has.
  struct Server {
    Number id = 0;  ///< as a participant
    Database database;
    std::array<RelayWriter, relay::count> relays = {};
    SendingQueues queues = {};
    std::array<Number, relay::count> acknacks = {};  ///< sent so far
  };
  /// A client's reader of one relay.
  struct Learner {
    std::int64_t base = 1;
    std::int64_t announced = 0;
    std::vector<bool> received;   ///< by number
    std::int64_t heartbeats = 0;  ///< the number of the last HEARTBEAT; in a life

    [[nodiscard]] bool has(std::int64_t number) const {
      const auto k = static_cast<std::size_t>(number);
      return k < received.size() && received[k];
    }
    void receive(std::int64_t number) {
      const auto k = static_cast<std::size_t>(number);
      if (received.size() <= k) received.resize(2 * k + 1);
      received[k] = true;
    }
  };
  /// Server k has its own announcement alone.
  [[nodiscard]] Server begin(Number k) const {
    const Number id = steps_of_.topology.first_server() + k;
    Server one{id, {steps_of_.topology, id, dds().discovery, dds().server}};
    one.relays[relay::announcements].append(one.database.announcement(id));
    return one;
  }

  Host& host() { return static_cast<Host&>(*this); }
  [[nodiscard]] const DdsProfile& dds() const { return steps_of_.scenario.dds; }
  [[nodiscard]] const Pair& ends_of(Number pair) const { return steps_of_.topology.pair(pair); }
  /// Only a mistake asks for that of a client.
  [[nodiscard]] Number place_of(Number id) const {
    const Topology& topology = steps_of_.topology;
    return topology.is_server(id) ? id - topology.first_server() : 0;
  }
  [[nodiscard]] const Server& server_of(Number id) const { return servers_[place_of(id)]; }
  [[nodiscard]] Server& server_of(Number id) { return servers_[place_of(id)]; }
  template <class World>
  [[nodiscard]] const Server& server_at(const World& w) const {
    return server_of(w.template number<comp::owner::participant>());
  }
  template <class World>
  [[nodiscard]] Server& server_at(const World& w) {
    return server_of(w.template number<comp::owner::participant>());
  }
  [[nodiscard]] Learner& learner(Number r) {
    const Number row = ServerNumbers::row_of_pair(r / relay::count, steps_of_.topology);
    return learners_[relay::count * row + r % relay::count];
  }
  /// The writer of a relation, by number.
  [[nodiscard]] Number writer_of(Number relation) const {
    return relay::count * ends_of(relation / relay::count).source + relation % relay::count;
  }
  [[nodiscard]] const RelayWriter& writer(Number w) const {
    return server_of(w / relay::count).relays[w % relay::count];
  }
  [[nodiscard]] RelayWriter& writer(Number w) {
    return server_of(w / relay::count).relays[w % relay::count];
  }
  [[nodiscard]] RelayWriter::Reader& about(Number r) { return writer(writer_of(r)).about[r]; }
  template <class World>
  [[nodiscard]] const RelayWriter& relay_at(const World& w) const {
    return writer(w.template number<comp::owner::writer>());
  }
  template <class World>
  [[nodiscard]] static bool is_of_announcements(const World& w) {
    return w.template number<comp::owner::writer>() % relay::count == relay::announcements;
  }
  template <class World>
  [[nodiscard]] static std::int64_t of_relay(const World& w, Nanoseconds of_announcements,
                                             Nanoseconds of_descriptors) {
    return (is_of_announcements(w) ? of_announcements : of_descriptors).count();
  }
  template <class Event>
  fsm::Stepper<fsm::ChangeForReader>::Output step(RelayWriter::Entry& entry, Number relation,
                                                  bool listed = false, bool below_base = false) {
    return changes_.template step<Event>(entry.state, {.listed = listed, .below_base = below_base},
                                         relation / relay::count);
  }
  template <class State>
  [[nodiscard]] static bool is_in(const RelayWriter::Entry& entry) {
    return entry.state == fsm::Reflect<fsm::ChangeForReader>::id<State>;
  }
  [[nodiscard]] Relayed asks(Number relation, bool initial);
  [[nodiscard]] Relayed data_of(const Server& one, SendingQueues::Entry entry) const;
  /// It announces all that there is.
  [[nodiscard]] Relayed with_heartbeat(Number relation, Relayed relayed) {
    relayed.has_heartbeat = true;
    RelayWriter& relay = writer(writer_of(relation));
    relayed.first = relay.first();
    relayed.last = relay.last();
    relayed.count = ++relay.heartbeats;
    return relayed;
  }
  void learn(Number relation, const Relayed& relayed);
  void learn_from_server(const Pair& ends, const Relayed& relayed);
  void note_acknowledgements(Server& one);
  void insert_all(Server& one, const Database::Lists& lists);
  bool is_pending(Server& one, Number relay, std::int64_t number, Item item);
  static void remove(Server& one, Number relay, Item item) {
    if (one.relays[relay].number_of(item) == 0) return;
    one.relays[relay].remove(item);
    one.queues.remove({relay, item});
  }
  static void leave_history(Server& one, Number relay, Item item) {
    remove(one, relay, item);
    one.database.forget(item);
  }
  [[nodiscard]] static Number relay_of(const Server& one, Item item) {
    const Database::Contents& contents = one.database.contents(item);
    if (contents.is_announcement) return relay::announcements;
    return contents.stream == Stream::pub ? relay::publications : relay::subscriptions;
  }
  template <class Occasion>
  void run_for_relay(const Server& one, Number relay) {
    host().template run<fsm::composition::Happens<Occasion>>(relay::count * one.id + relay);
  }
  bool insert(Server& one, Number relay, Item item);
  std::int64_t deliver(Server& one, SendingQueues::Entry entry);
  bool skip_before(Number relation, std::int64_t number);

  RunState& steps_of_;
  std::vector<Server> servers_;
  std::vector<Learner> learners_;  // by server, client and relay
  // Of what is being done.
  bool heartbeat_is_new_ = false;
  bool some_requested_ = false;
  bool some_irrelevant_ = false;
  std::vector<std::int64_t> irrelevant_;
  std::int64_t packets_sent_ = 0;
  SendingQueues::Entry served_;

  Driver<fsm::ChangeForReader> changes_;
};

}  // namespace stormproof::model::fastdds
