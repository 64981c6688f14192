// Follows the composition of Fast DDS with a Discovery Server: a second host of its rules, with a
// plain database, relays and sending thread of its own (specs/guide/discovery-server.md). What
// clients send to the server is followed by Fast DDS's rules. By source file:
//   followed_server.cpp         what starts rules, what observers hear, what a client learns
//   followed_server_relays.cpp  the server's writers
//   followed_database.cpp       whom it has to tell what
//
// Beside the relations and writers of the two streams there are those of the server's relays, which
// are numbered behind them.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <tuple>
#include <type_traits>
#include <vector>

#include "fsm/change_for_reader.hpp"
#include "fsm/composition/server.hpp"
#include "fsm/stepper.hpp"
#include "props/monitors/followed_database.hpp"
#include "props/monitors/followed_fastdds.hpp"

namespace stormproof::props {

namespace server = comp::server;
namespace relay = model::fastdds::relay;

namespace detail {
/// The types of a list, then the others that it lacks.
template <class Some, class... More>
struct United {
  using type = Some;
};
template <class... Some, class T, class... More>
struct United<fsm::TypeList<Some...>, T, More...>
    : United<std::conditional_t<(std::is_same_v<Some, T> || ...), fsm::TypeList<Some...>,
                                fsm::TypeList<Some..., T>>,
             More...> {};
template <class Some, class... More>
auto united(Some, fsm::TypeList<More...>) -> typename United<Some, More...>::type;
}  // namespace detail

/// The rules of both, and what they are about.
struct ServerAndClients {
  using Server = server::FastDdsServer;
  using Clients = fastdds::FastDds;
  using Parts = decltype(detail::united(Clients::Parts{}, Server::Parts{}));
  using Timers = decltype(detail::united(Clients::Timers{}, Server::Timers{}));
  using State = decltype(detail::united(Clients::State{}, Server::State{}));
  using Rules = comp::Joined<Server::Rules, Clients::Rules>;
  using IsOpen = Clients::IsOpen;
};

/// One of the server's writers.
struct FollowedRelay {
  struct Reader {
    std::int64_t low = 0;
    std::map<std::int64_t, fsm::StateId> list;  // what it has to be told, by number
    std::set<std::int64_t> sent;                // numbers that have ever been sent to it
  };

  std::map<std::int64_t, RelayedItem> history;  // by number
  std::int64_t next = 1;
  std::vector<std::uint32_t> readers;     // relations, in match order
  std::map<std::uint32_t, Reader> about;  // by relation

  [[nodiscard]] std::int64_t first() const {
    return history.empty() ? next : history.begin()->first;
  }
  [[nodiscard]] std::int64_t last() const {
    return history.empty() ? next - 1 : history.rbegin()->first;
  }
  [[nodiscard]] std::int64_t number_of(const RelayedItem& item) const {
    for (const auto& [number, one] : history) {
      if (one == item) return number;
    }
    return 0;
  }
};

/// A client's reader of one relay.
struct FollowedLearner {
  std::int64_t base = 1;
  std::int64_t announced = 0;
  std::set<std::int64_t> received;
};

class ServerFollower final : public FollowedFastDds<ServerFollower, ServerAndClients> {
 public:
  static constexpr bool cancels_any_timer = true;

  ServerFollower(const model::Scenario& scenario, const model::Topology& topology);

  void started() override;
  void received(const Message& message, std::uint32_t receiver,
                model::Nanoseconds emitted) override;

  // Places.
  [[nodiscard]] std::uint32_t server_id() const { return topology_.participant_count() - 1; }
  [[nodiscard]] std::uint32_t relay_relation(std::uint32_t pair, std::uint32_t r) const {
    return topology_.relation_count() + relay::count * pair + r;
  }
  [[nodiscard]] std::uint32_t relay_writer(std::uint32_t r) const {
    return 2 * topology_.participant_count() + r;
  }
  [[nodiscard]] Place relation_place(std::uint32_t relation) const;
  [[nodiscard]] Place writer_place(std::uint32_t writer) const;
  [[nodiscard]] std::uint32_t descriptor_count(std::uint32_t writer) const {
    return writer < relay_writer(0) ? FollowedFastDds::descriptor_count(writer) : 0;
  }
  [[nodiscard]] std::array<std::uint32_t, relay::count> streams_of(std::uint32_t pair) const {
    return {relay_relation(pair, 0), relay_relation(pair, 1), relay_relation(pair, 2)};
  }
  [[nodiscard]] const std::vector<std::uint32_t>& readers(std::uint32_t writer) {
    if (writer < relay_writer(0)) return FollowedFastDds::readers(writer);
    return relays_[writer - relay_writer(0)].readers;
  }
  // Observers hear of the pair, or of the server, and of the relay when an event is due.
  template <class P>
  [[nodiscard]] model::MachineRef machine_at(const Place& place) const {
    using enum model::MachineRef::Kind;
    model::MachineRef machine = FollowedFastDds::template machine_at<P>(place);
    const bool of_a_relay = place.writer >= relay_writer(0);
    if (P::owner == comp::owner::pair || (of_a_relay && P::owner == comp::owner::relation)) {
      machine.kind = pair;
      machine.subject = place.pair;
    } else if (of_a_relay && P::owner == comp::owner::writer) {
      machine.kind = participant;
      machine.subject = server_id();
    }
    return machine;
  }
  [[nodiscard]] std::uint32_t owner_of(const model::Event& event) const;
  template <class T>
  [[nodiscard]] std::uint32_t subject_of(std::uint32_t owner) const {
    if (T::owner == comp::owner::relation && owner >= topology_.relation_count()) {
      return (owner - topology_.relation_count()) / relay::count;
    }
    if (T::owner == comp::owner::writer && owner >= relay_writer(0)) return server_id();
    return owner;
  }

  // State.
  using FollowedFastDds::all_are_set;
  using FollowedFastDds::becomes;
  void becomes(comp::X, const Place& place);
  void all_are_set(comp::X, const Place& place);
  void becomes(server::RelayOpen, const Place& place);

  // What only the host knows.
  using FollowedFastDds::answer;
  bool answer(server::OfAnnouncements, const World& w) const {
    return relay_of(w) == relay::announcements;
  }
  bool answer(server::CrossHost, const World& w) const {
    return topology_.pair(w.place().pair).cross_host;
  }
  bool answer(server::HistoryNotEmpty, const World& w) const {
    return !relays_[relay_of(w)].history.empty();
  }
  bool answer(server::LacksSomething, const World& w) const;
  bool answer(server::SomeRequested, const World&) const { return some_requested_; }
  bool answer(server::SomeListed, const World& w) const {
    return !w.heard().relayed.of->numbers.empty();
  }
  bool answer(server::SomeIrrelevant, const World&) const { return some_irrelevant_; }
  bool answer(server::SomethingToSend, const World&) const {
    return !fresh_.empty() || !again_.empty();
  }
  bool answer(server::SomethingUnacknowledged, const World&) const;
  std::int64_t answer(server::PacketsSent, const World&) const { return packets_sent_; }
  std::int64_t answer(server::SendingCost, const World&) const {
    return packets_sent_ * scenario_.deployment.cost_to_send().count();
  }
  std::int64_t answer(server::RelayHeartbeatPeriod, const World& w) const {
    return of_relay(w, dds().server.pdp_heartbeat_period, dds().sedp.heartbeat_period);
  }
  std::int64_t answer(server::RelayResponseDelay, const World& w) const {
    return of_relay(w, dds().server.pdp_nack_response_delay, dds().sedp.nack_response_delay);
  }
  std::int64_t answer(server::RelaySuppressionDuration, const World& w) const {
    return of_relay(w, dds().server.pdp_nack_suppression_duration,
                    dds().sedp.nack_suppression_duration);
  }
  std::int64_t answer(server::LearnerResponseDelay, const World& w) const {
    return of_relay(w, dds().server.pdp_heartbeat_response_delay,
                    dds().sedp.heartbeat_response_delay);
  }

  // Packets.
  using FollowedFastDds::emit;
  using FollowedFastDds::kind_of;
  static model::PacketKind kind_of(server::Registration) { return model::PacketKind::registration; }
  static model::PacketKind kind_of(server::RegistrationHeartbeat) {
    return model::PacketKind::registration_heartbeat;
  }
  static model::PacketKind kind_of(server::RegistrationAckNack) {
    return model::PacketKind::registration_acknack;
  }
  template <class... Sayings>
  void emit(server::RelayedData, World& w, const std::tuple<Sayings...>&, comp::Site site) {
    expect_relayed(w, with_heartbeat(w, served()), site);
  }
  template <class... Sayings>
  void emit(server::RelayHeartbeat, World& w, const std::tuple<Sayings...>&, comp::Site site) {
    expect_relayed(w, with_heartbeat(w, {}), site);
  }
  template <class... Sayings>
  void emit(server::Gap, World& w, const std::tuple<Sayings...>&, comp::Site site) {
    model::Relayed gap;
    gap.numbers = irrelevant_;
    if (sizeof...(Sayings) > 0) gap = with_heartbeat(w, std::move(gap));
    expect_relayed(w, std::move(gap), site);
  }
  template <class... Sayings>
  void emit(server::RelayedAckNack, World& w, const std::tuple<Sayings...>&, comp::Site site) {
    expect_acknack(w, sizeof...(Sayings) > 0, site);
  }

  // Opaque steps.
  using FollowedFastDds::perform;
  void perform(server::JoinParticipants, const World& w) { database_.join(w.place().participant); }
  void perform(server::OpenReaders, const World& w);
  void perform(server::OpenLiveliness, const World& w) { open_sides(w.place().pair); }
  void perform(server::OpenOwnWriter, const World& w);
  void perform(server::ListRelevant, const World& w);
  void perform(server::TakeAckNack, const World& w);
  void perform(server::QueueAgain, const World& w);
  void perform(server::EndSuppression, const World& w);
  void perform(server::UpdateDatabase, const World&);
  void perform(server::DeliverNext, const World&);
  void perform(server::TakeRelayed, const World& w);

 private:
  [[nodiscard]] std::uint32_t relay_of(const World& w) const {
    return w.place().writer - relay_writer(0);
  }
  [[nodiscard]] std::int64_t of_relay(const World& w, model::Nanoseconds of_announcements,
                                      model::Nanoseconds of_descriptors) const {
    return (relay_of(w) == relay::announcements ? of_announcements : of_descriptors).count();
  }

  // followed_server.cpp
  void learn(const World& w, const model::Relayed& relayed);
  [[nodiscard]] bool ends_now(const World& w) const {
    World here = w;
    return answer(comp::RunEnds{}, here);
  }
  [[nodiscard]] Message message_at(const World& w, model::PacketKind kind) const;
  void expect_acknack(const World& w, bool initial, comp::Site site);
  void expect_relayed(const World& w, model::Relayed relayed, comp::Site site);

  // followed_server_relays.cpp
  FollowedRelay& relay_at(const Place& place) { return relays_[place.writer - relay_writer(0)]; }
  FollowedRelay::Reader& reader_at(const Place& place) {
    return relay_at(place).about[place.relation];
  }
  std::vector<std::int64_t> numbers_listed(const Place& place);
  template <class Event>
  fsm::Stepper<fsm::ChangeForReader>::Output move_change(
      const Place& place, std::int64_t number,
      const fsm::Stepper<fsm::ChangeForReader>::Input& input = {});
  void remove(const RelayedItem& item);
  void note_acknowledgements();
  bool is_pending(std::int64_t number, const RelayedItem& item);
  void insert(const RelayedItem& item);
  std::int64_t deliver(const RelayedItem& item);
  bool expect_gap_before(const Place& place, std::int64_t number);
  [[nodiscard]] model::Relayed served() const;
  [[nodiscard]] model::Relayed with_heartbeat(const World& w, model::Relayed relayed) const;

  FollowedDatabase database_;
  std::array<FollowedRelay, relay::count> relays_;
  std::deque<RelayedItem> fresh_;                      // what the sending thread has to send first
  std::deque<RelayedItem> again_;                      // and then
  std::map<std::uint32_t, FollowedLearner> learners_;  // by relation
  fsm::Stepper<fsm::ChangeForReader> changes_;
  // Of what is being done.
  bool some_arrived_ = false;
  bool some_requested_ = false;
  bool some_irrelevant_ = false;
  std::vector<std::int64_t> irrelevant_;
  std::int64_t packets_sent_ = 0;
  RelayedItem served_;
};

}  // namespace stormproof::props
