// Follows Fast DDS's rules, whether or not participants have a life: which packets reach whom, how
// descriptors become messages, and which sides of control-only relations open.
#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "model/fastdds/endpoints.hpp"
#include "model/fastdds/peer_ports.hpp"
#include "props/monitors/control_sides.hpp"
#include "props/monitors/followed_rules.hpp"

namespace stormproof::props {

namespace fastdds = comp::fastdds;
namespace control = comp::control;

/// `Self` is the follower of the composition.
template <class Self, class Composition>
class FollowedFastDds : public FollowedRules<Self, Composition> {
 public:
  using Base = FollowedRules<Self, Composition>;
  using typename Base::World;
  static constexpr bool readers_in_order_of_match = true;
  static constexpr bool cancels_any_timer = false;
  using Base::Base;
  using Base::dds;
  using Base::expect;
  using Base::expect_timer;
  using Base::readers;
  using Base::relation_place;
  using Base::writer_place;

  /// Announcement 0 of everybody; endpoints are created when the deployment says.
  void started() override {
    begin("The start");
    for (std::uint32_t i = 0; i < topology_.participant_count(); ++i) {
      expect_timer(comp::Announcement{}, i, topology_.start(i), {});
      take_creations(i);
    }
  }
  void due(const model::Event& event) override {
    if (event.kind != model::EventKind::endpoint_creation) return Base::due(event);
    const std::uint32_t user_publications =
        topology_.descriptor_count(event.subject, model::Stream::pub) -
        model::fastdds::default_publications;
    const bool may_wait = scenario_.wireless.sender == model::Sender::stalls;
    const std::uint32_t k = may_wait ? created_[event.subject]++ : event.detail;
    const auto [stream, d] = model::fastdds::creation_order(k, user_publications);
    Place place = writer_place(2 * event.subject + static_cast<std::uint32_t>(stream));
    place.descriptor = d;
    this->template run<comp::Happens<fastdds::Created>>(place);
  }
  void received(const Message& message, std::uint32_t receiver, model::Nanoseconds) override {
    using enum model::PacketKind;
    if (!has_started(receiver)) return;
    if (message.kind == spdp_multicast) {
      const std::uint32_t pair = topology_.pair_between(message.pair, receiver);
      this->template run<comp::Received<comp::SpdpMulticast>>(relation_place(2 * pair));
      return;
    }
    const Place side{.control = message.detail};
    if (message.kind == user_heartbeat)
      this->template run<comp::Received<control::UserHeartbeat>>(side, &message);
    if (message.kind == user_acknack)
      this->template run<comp::Received<control::UserAckNack>>(side, &message);
    const Place place = relation_place(message.relation());
    if (message.kind == spdp_unicast) this->template run<comp::Received<comp::SpdpUnicast>>(place);
    if (message.kind == data) this->template run<comp::Received<fastdds::Data>>(place, &message);
    if (message.kind == heartbeat)
      this->template run<comp::Received<fastdds::Heartbeat>>(place, &message);
    if (message.kind == acknack)
      this->template run<comp::Received<fastdds::AckNack>>(place, &message);
  }

  static model::PacketKind kind_of(comp::SpdpUnicast) { return model::PacketKind::spdp_unicast; }
  static model::PacketKind kind_of(fastdds::Heartbeat) { return model::PacketKind::heartbeat; }
  static model::PacketKind kind_of(fastdds::AckNack) { return model::PacketKind::acknack; }
  static model::PacketKind kind_of(control::UserHeartbeat) {
    return model::PacketKind::user_heartbeat;
  }
  static model::PacketKind kind_of(control::UserAckNack) { return model::PacketKind::user_acknack; }
  using Base::answer;
  bool answer(fastdds::CrossHost, World& w) const {
    return topology_.pair(w.place().pair).cross_host;
  }

  using Base::emit;
  /// To every participant of the same host, then to the others; with static peers to the ports.
  void emit(comp::SpdpMulticast, World& w, const std::tuple<>&, comp::Site site) {
    const std::uint32_t i = w.place().participant;
    if (scenario_.dds.discovery == model::Discovery::static_peers) return emit_to_ports(i, site);
    Message message;
    message.kind = model::PacketKind::spdp_multicast;
    message.pair = i;
    for (std::uint32_t pair = topology_.first_pair(i); pair < topology_.first_pair(i + 1); ++pair) {
      if (topology_.pair(pair).cross_host) continue;
      message.loops_to = topology_.pair(pair).destination;
      expect(message, site);
    }
    message.loops_to = UINT32_MAX;
    expect(message, site);
  }

  // The asynchronous queue.
  using Base::becomes;
  void becomes(fastdds::Enqueued, const Place& place) {
    Place entry = writer_place(place.writer);
    entry.descriptor = place.descriptor;
    queues_[place.participant].push_back(entry);
  }
  std::optional<Place> next_in_queue(std::uint32_t i) {
    if (const auto open = unfinished_.extract(i)) message_ = open.mapped();
    std::deque<Place>& queue = queues_[i];
    if (queue.empty() || stalls(i)) return std::nullopt;
    const Place first = queue.front();
    queue.pop_front();
    return first;
  }

  using Base::perform;
  void perform(fastdds::Clock::SendBatch, World& w) {
    this->template send_batch<fastdds::Implementation>(w);
  }
  template <class To>
  void perform(fastdds::Pack, World& w, To) {
    std::vector<std::uint32_t> served;
    w.for_readers([&](World& r) {
      if (To::serves(r)) served.push_back(r.place().relation);
    });
    const std::uint32_t d = w.place().descriptor;
    const bool joins = message_.writer == w.place().writer && message_.readers == served &&
                       !message_.descriptors.has(d);
    // Whether there was room shows in the run: only a flush sends something now.
    if (!joins || deeds_.template next<Message>() != nullptr) flush();
    if (!joins || message_.descriptors.empty()) {
      message_.writer = w.place().writer;
      message_.readers = std::move(served);
    }
    message_.descriptors.add(d);
  }
  /// Whether the budget is used up shows when the message is flushed.
  template <class To>
  void perform(fastdds::Charge, World& w, To) {
    if (dds().sedp.piggyback == model::Piggyback::off) return;
    const bool to_all = message_.readers == readers(w.place().writer);
    (to_all ? message_.heartbeat_may_ride : message_.heartbeats_may_follow) = true;
  }
  template <class To>
  void perform(fastdds::Flush, World&, To) {
    flush();
  }
  /// Between the participant and one peer, or any.
  void perform(control::OpenTopics, World& w) {
    const std::uint32_t i = w.place().participant;
    if (w.place().pair != Place::nowhere) return open_sides(w.place().pair);
    for (std::uint32_t pair = topology_.first_pair(i); pair < topology_.first_pair(i + 1); ++pair) {
      open_sides(topology_.pair(pair).reverse);
    }
  }

 protected:
  using Base::begin;
  using Base::deeds_;
  using Base::has_started;
  using Base::now_;
  using Base::scenario_;
  using Base::site_;
  using Base::topology_;
  using Base::world_at;

  /// The endpoints of participant i are created when the deployment says.
  void take_creations(std::uint32_t i) {
    Base::take_creations(i, [&](const Scheduled& it) { creations_[i].insert(it.insertion); });
  }

  /// Each side at the destination of the pair that has what it needs is open.
  void open_sides(std::uint32_t pair) {
    const auto open = [&](std::uint32_t number, const ControlSides::Needs& needs, auto part,
                          auto occasion) {
      const Place side{.control = number};
      using Part = decltype(part);
      constexpr fsm::StateId closed = fsm::Flyweight<typename Part::Machine>::initial;
      if (this->template state<Part>(side) != closed || !has(needs)) return;
      World w = world_at(side);
      w.raise(occasion);
    };
    sides_.for_each(pair, false, [&](std::uint32_t number, const ControlSides::Needs& needs) {
      open(number, needs, control::ControlReaderSide{}, control::ControlReaderOpens{});
    });
    const std::uint32_t back = topology_.pair(pair).reverse;
    sides_.for_each(back, true, [&](std::uint32_t number, const ControlSides::Needs& needs) {
      open(number, needs, control::ControlWriterSide{}, control::ControlWriterOpens{});
    });
  }

  const ControlSides sides_{topology_};
  std::map<std::uint32_t, std::deque<Place>> queues_;  // by participant, first in, first out
  std::map<std::uint32_t, std::set<std::uint64_t>> creations_;  // by participant; insertion numbers

 private:
  /// The message that is open, if it carries a descriptor.
  struct OpenMessage {
    std::uint32_t writer = 0;
    std::vector<std::uint32_t> readers;  ///< relations
    Descriptors descriptors;
    bool heartbeat_may_ride = false;
    bool heartbeats_may_follow = false;  ///< to all readers, of whom it goes to some
  };

  /// Whether the run ends for now, though entries are left, because its participant stalls: then it
  /// is requested again. The message stays open; if its DATA has gone, HEARTBEATs are left.
  bool stalls(std::uint32_t i) {
    if (scenario_.wireless.sender != model::Sender::stalls) return false;
    std::size_t messages = 0;
    while (deeds_.template next<Message>(messages) != nullptr) ++messages;
    const Move* move = deeds_.template next<Move>(messages);
    if (move == nullptr || move->machine.kind != model::MachineRef::Kind::participant) return false;
    if (move->event != fsm::name_of<fsm::single_shot::Requested>()) return false;
    if (messages > 0) {
      const bool heartbeats = message_.heartbeats_may_follow;
      const std::uint32_t writer = message_.writer;
      message_.heartbeats_may_follow = false;
      flush();
      if (heartbeats) message_ = {writer, readers(writer), {}, true, true};
    }
    World w = world_at({.participant = i});
    comp::request<fastdds::AsyncRun, comp::Immediately, fastdds::AsyncRunDue>(w);
    unfinished_[i] = std::exchange(message_, {});
    return true;
  }

  /// What the message carries goes to each of its readers, with or without a HEARTBEAT.
  void flush() {
    const OpenMessage message = std::exchange(message_, {});
    if (!message.descriptors.empty()) {
      const Message* first = deeds_.template next<Message>();
      const bool rides = message.heartbeat_may_ride && first != nullptr && first->carries_heartbeat;
      send(model::PacketKind::data, message.readers, message.descriptors, rides);
    }
    const Message* next = deeds_.template next<Message>();
    if (!message.heartbeats_may_follow || next == nullptr) return;
    if (next->kind != model::PacketKind::heartbeat) return;
    send(model::PacketKind::heartbeat, readers(message.writer), {}, false);
  }
  /// To readers of one writer.
  void send(model::PacketKind kind, const std::vector<std::uint32_t>& relations,
            const Descriptors& descriptors, bool carries_heartbeat) {
    if (relations.empty()) return;
    Message wanted;
    wanted.kind = kind;
    wanted.descriptors = descriptors;
    wanted.carries_heartbeat = carries_heartbeat;
    if (carries_heartbeat || kind == model::PacketKind::heartbeat) {
      World w = world_at(relation_place(relations.front()));
      wanted.detail =
          static_cast<std::uint32_t>(w.count([](World& d) { return d(fastdds::Exists{}); }));
    }
    for (const std::uint32_t relation : relations) {
      wanted.pair = relation / 2;
      wanted.stream = model::streams[relation % 2];
      expect(wanted, site_);
    }
  }

  /// A copy to each port of every host that is asked; on one's own host, if somebody is there.
  void emit_to_ports(std::uint32_t i, comp::Site site) {
    const model::Deployment& deployment = scenario_.deployment;
    Message message;
    message.kind = model::PacketKind::spdp_unicast;
    for (const auto& [host, there] : model::fastdds::participants_at_ports(deployment)) {
      for (std::uint32_t port = 0; port < dds().peer_ports; ++port) {
        message.to_nobody = port >= there.size();
        const std::uint32_t somebody = message.to_nobody ? there.front() : there[port];
        if (somebody == i) continue;
        if (message.to_nobody && host == deployment.participants[i].host) continue;
        message.pair = topology_.pair_between(i, somebody);
        expect(message, site);
      }
    }
  }

  bool has(const ControlSides::Needs& needs) {
    if (needs.liveliness) return this->template value<comp::Recognised>({.pair = needs.pair}) != 0;
    const Place own{.writer = needs.writer, .descriptor = needs.created};
    const Place other{.relation = 2 * needs.pair + needs.stream, .descriptor = needs.notified};
    return this->template value<fastdds::Exists>(own) != 0 &&
           this->template value<fastdds::Notified>(other) != 0;
  }

  OpenMessage message_;
  std::map<std::uint32_t, OpenMessage> unfinished_;  // by participant, while it stalls
  std::map<std::uint32_t, std::uint32_t> created_;   // by participant, if it may stall
};

}  // namespace stormproof::props
