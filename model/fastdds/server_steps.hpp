// What the steps of a Discovery Server do (fsm/composition/server_parts.hpp), and what they are
// about: its database, the lists of its writers, the queues of the thread that sends, and what
// clients have heard of it. It is stated once for whoever executes the rules: the simulator, and
// the audit of its runs; both include server_relays.hpp, which has the bodies. `Host` says
//   run<Trigger>(n, packet)   the rule of a trigger, for owner n
//   learn(client, relayed) a client learns what it has been sent
//   runs_for_clients<Occasion>(relation), open_builtin(pair)   the rules of any participant
//   forget_exchange(pair)  the same, if participants have a life
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "fsm/composition/server_life.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/running_world.hpp"
#include "model/engine/writer_layout.hpp"
#include "model/fastdds/database.hpp"
#include "model/fastdds/relay.hpp"
#include "model/fastdds/relayed.hpp"
#include "model/fastdds/server_numbers.hpp"

namespace stormproof::model::fastdds {

namespace server = fsm::composition::server;

template <class Host>
class ServerSteps {
  using Number = std::uint32_t;

 public:
  explicit ServerSteps(RunState& run)
      : steps_of_{run},
        database_{run.topology, run.scenario.dds.discovery, run.scenario.dds.server},
        learners_(std::size_t{relay::count} * run.scenario.deployment.size()),
        changes_{run, MachineRef::Kind::pair} {
    begin();
  }

  [[nodiscard]] static WriterLayout writer_layout() { return {relay::count, relay::count}; }
  [[nodiscard]] static Number samples_of(Number) { return 0; }
  [[nodiscard]] const std::vector<Number>& readers(Number w) const {
    return relays_[w % relay::count].readers;
  }
  void changed(server::RelayOpen, Number r, bool open) {
    RelayWriter& writer = relays_[r % relay::count];
    if (!open) {
      std::erase(writer.readers, r);
      writer.about.erase(r);
      return;
    }
    writer.readers.push_back(r);
    about(r).low = writer.first() - 1;
  }
  /// Of a reader that closes its list is gone.
  void renew(server::Change, Number) {}

  /// Runs the rule of a packet between the server and a client; false if it is another one.
  bool take_in(const Packet& packet);

  // What only the host knows.
  template <class World>
  [[nodiscard]] bool answer(server::OfAnnouncements, const World& w) const {
    return relay_at(w) == relay::announcements;
  }
  template <class World>
  [[nodiscard]] bool answer(server::HistoryNotEmpty, const World& w) const {
    return !relays_[relay_at(w)].empty();
  }
  template <class World>
  [[nodiscard]] bool answer(server::TellsOfServer, const World& w) const {
    const Relayed& relayed = *w.packet().relayed;
    return relayed.is_announcement && relayed.participant == server_id();
  }
  template <class World>
  [[nodiscard]] bool answer(server::ToServer, const World& w) const {
    return steps_of_.topology.pair(w.template number<comp::owner::pair>()).destination ==
           server_id();
  }
  template <class World>
  [[nodiscard]] bool answer(server::IsInDatabase, const World& w) const {
    return database_.is_in(client_of(w.template number<comp::owner::pair>()));
  }
  template <class World>
  [[nodiscard]] bool answer(server::HeartbeatIsNew, const World&) const {
    return heartbeat_is_new_;
  }
  template <class World>
  [[nodiscard]] bool answer(server::IsAhead, const World& w) const {
    return w.packet().relayed->base > relays_[relay_at(w)].next;
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
  [[nodiscard]] bool answer(server::SomethingToSend, const World&) const {
    return !queues_.empty();
  }
  template <class World>
  [[nodiscard]] bool answer(server::SomethingUnacknowledged, const World&) const {
    return !database_.all_noted || relays_[relay::announcements].history.size() > 1 ||
           !relays_[relay::publications].empty() || !relays_[relay::subscriptions].empty();
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
  void perform(server::JoinParticipants, World& w) {
    database_.join(client_of(w.template number<comp::owner::pair>()));
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
    const Number pair = steps_of_.topology.pair(w.template number<comp::owner::pair>()).reverse;
    const Number s = relay_at(w) == relay::publications ? 0 : 1;
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
  void perform(server::UpdateDatabase, World&) {
    note_acknowledgements();
    insert_all(database_.update());
  }
  template <class World>
  void perform(server::UpdateWithGoodbyes, World&);
  template <class World>
  void perform(server::DeliverNext, World&) {
    packets_sent_ = 0;
    while (packets_sent_ == 0 && !queues_.empty()) packets_sent_ = deliver(queues_.take());
  }
  template <class World>
  void perform(server::TakeRelayed, World& w);
  template <class World>
  void perform(server::ForgetExchange, World& w) {
    host().forget_exchange(w.template number<comp::owner::pair>());
  }
  template <class World>
  void perform(server::JoinGoodbyes, World& w) {
    database_.leave(client_of(w.template number<comp::owner::pair>()));
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
  [[nodiscard]] Number server_id() const { return steps_of_.scenario.deployment.size(); }
  /// The client of a pair with the server.
  [[nodiscard]] Number client_of(Number pair) const {
    return ServerNumbers::client_of(pair, steps_of_);
  }
  /// A descriptor that is new to the server.
  void arrive(Number i, Stream s, Number d) { database_.arrive(database_.descriptor(i, s, d)); }

  /// Which one its next ACKNACK to clients is, of their announcements or of a stream.
  [[nodiscard]] Number next_acknack(Number relay) { return ++acknacks_[relay]; }

  // What packets carry.
  /// It asks for all that is missing of what is announced; an initial one claims nothing.
  [[nodiscard]] Relayed contents(server::RelayedAckNack, Number relation, bool initial) {
    return asks(relation, initial);
  }
  /// What the sending thread serves; otherwise it is the server's own announcement.
  [[nodiscard]] Relayed contents(server::RelayedData, Number relation, bool serves) {
    if (serves) return with_heartbeat(relation, data_of(served_));
    return data_of({relay::announcements, database_.announcement(server_id())});
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
  /// It has its own announcement alone.
  void begin() { relays_[relay::announcements].append(database_.announcement(server_id())); }

  Host& host() { return static_cast<Host&>(*this); }
  [[nodiscard]] const DdsProfile& dds() const { return steps_of_.scenario.dds; }
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
  [[nodiscard]] Relayed data_of(SendingQueues::Entry entry) const;
  /// It announces all that there is.
  [[nodiscard]] Relayed with_heartbeat(Number relation, Relayed relayed) {
    relayed.has_heartbeat = true;
    relayed.first = relays_[relation % relay::count].first();
    relayed.last = relays_[relation % relay::count].last();
    relayed.count = ++relays_[relation % relay::count].heartbeats;
    return relayed;
  }
  void note_acknowledgements();
  void insert_all(const Database::Lists& lists);
  bool is_pending(Number relay, std::int64_t number, Item item);
  void remove(Number relay, Item item) {
    if (relays_[relay].number_of(item) == 0) return;
    relays_[relay].remove(item);
    queues_.remove({relay, item});
  }
  void leave_history(Number relay, Item item) {
    remove(relay, item);
    database_.forget(item);
  }
  [[nodiscard]] Number relay_of(Item item) const {
    const Database::Contents& contents = database_.contents(item);
    if (contents.is_announcement) return relay::announcements;
    return contents.stream == Stream::pub ? relay::publications : relay::subscriptions;
  }
  template <class Occasion>
  void run_for_relay(Number relay) {
    host().template run<fsm::composition::Happens<Occasion>>(relay::count * server_id() + relay);
  }
  bool insert(Number relay, Item item);
  std::int64_t deliver(SendingQueues::Entry entry);
  bool skip_before(Number relation, std::int64_t number);

  RunState& steps_of_;
  Database database_;
  std::array<RelayWriter, relay::count> relays_;
  SendingQueues queues_;
  std::vector<Learner> learners_;  // relay::count · client + relay
  std::array<Number, relay::count> acknacks_{};
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
