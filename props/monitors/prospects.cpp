// Keeps account of packets under way and of pending events.
//
// A packet is on its way from its emission until it is received or lost. Where its reception is an
// event of its own (constant delay; Fast DDS), the packet counts while that event is pending, so
// that a reception that nobody schedules brings nothing.
#include "props/monitors/prospects.hpp"

#include <algorithm>

#include "model/fastdds/peer_ports.hpp"
#include "props/monitors/delay_meter.hpp"

namespace stormproof::props {

using model::EventKind;
using model::PacketKind;

namespace {

constexpr std::uint32_t more = 1;
constexpr std::uint32_t less = UINT32_MAX;  // adds −1

/// Counts never go below 0: an event that comes twice has been scheduled twice, but a packet that
/// is received twice has not been sent twice.
template <class Count>
void add(Count& count, std::uint32_t change) {
  if (change == more)
    ++count;
  else if (count > 0)
    --count;
}

}  // namespace

Prospects::Prospects(const model::Scenario& scenario)
    : traits_{model::traits_of(scenario.dds)},
      rules_{model::rules_of(scenario.dds)},
      stateful_{traits_.writer == model::Writer::stateful},
      constant_delay_{scenario.wireless.kind == model::ServiceKind::constant_delay},
      each_side_{rules_.relation_opening == model::RelationOpening::each_side},
      accepts_unmatched_{!each_side_ || rules_.unmatched == model::Unmatched::accept},
      adaptive_{scenario.dds.sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive},
      hears_announcements_{model::fastdds::reached_by_announcements(scenario)},
      lost_packets_{scenario.wireless.lost_packets} {}

void Prospects::run_started(const model::Topology& topology) {
  topology_ = topology;
  heartbeats_.reset(topology);
  for (RelationWords& words : states_) words.reset(topology);
  data_.reset(topology, 0);
  requests_.reset(topology, 0);
  sources_.reset(topology, 0);
  relations_.assign(topology.relation_count(), {});
  writers_.assign(2 * std::size_t{topology.participant_count()}, {});
  participants_.assign(topology.participant_count(), {});
  copies_.assign(topology.pair_count(), 0);
  RelationWords& initial = states_[traits_.creates_endpoints_over_time ? absent : u];
  for (std::uint32_t rel = 0; rel < topology.relation_count(); ++rel) {
    for (std::uint32_t k = 0; k < initial.word_count(rel); ++k) {
      initial.word(rel, k) = RelationWords::below(topology.descriptor_count(rel), k);
    }
  }
}

void Prospects::event_started(const model::Event& event) {
  heartbeats_.started(event);
  count(event.kind, event.subject, less);
}

void Prospects::event_ended() {
  delivered_ = nullptr;
  if (constant_delay_) departing_ = {};
}

void Prospects::scheduled(std::uint64_t insertion, EventKind kind, std::uint32_t subject) {
  heartbeats_.scheduled(insertion, kind, subject);
  count(kind, subject, more);
  const bool reception = kind == EventKind::delayed_reception || kind == EventKind::reception;
  if (reception && delivered_ != nullptr) {
    move(load_of(*delivered_), more);
  } else if (reception && departing_.receptions < departing_.pairs.size()) {
    const std::size_t copy = departing_.receptions++;
    departing_.load.pair = departing_.pairs[copy];
    if (!is_lost(departing_.number + copy)) move(departing_.load, more);
  } else if (kind == EventKind::source_completion &&
             departing_.completions++ < departing_.pairs.size()) {
    in_source(departing_.load, more);
  }
}

/// One more or one less pending event; what has one less may have got stuck.
void Prospects::count(EventKind kind, std::uint32_t subject, std::uint32_t change) {
  switch (kind) {
    case EventKind::acknack_generation:
      add(relations_[subject].acknacks_due, change);
      return touch(subject);
    case EventKind::initial_acknack_due:
      add(relations_[subject].initials_due, change);
      return touch(subject);
    case EventKind::repair_generation:
      add(relations_[subject].repairs_due, change);
      return touch(subject);
    case EventKind::suppression_end:
      add(relations_[subject].suppressions, change);
      return touch(subject);
    case EventKind::nack_response:
      add(writers_[subject].responses_due, change);
      return touch_writer(subject);
    case EventKind::heartbeat_expiry:
    case EventKind::cycle_start:
    case EventKind::cycle_end:
      return touch_writer(subject);
    case EventKind::announcement_due:
      add(participants_[subject].announcements_due, change);
      return touch_participant(subject);
    case EventKind::endpoint_creation:
      add(participants_[subject].creations_due, change);
      return touch_participant(subject);
    case EventKind::async_run:
      add(participants_[subject].async_runs_due, change);
      return touch_participant(subject);
    default:
      return;
  }
}

Prospects::State Prospects::state_named(std::string_view name) {
  switch (name.size() == 1 ? name[0] : '?') {
    case 'U':
      return u;
    case 'R':
      return r;
    case 'Q':
      return q;
    case 'S':
      return s;
    case 'A':
      return a;
    default:
      return absent;
  }
}

void Prospects::transition(const model::Transition& fired) {
  if (fired.descriptors != 0) {
    states_[state_named(fired.before)].word(fired.machine.subject, fired.first_word) &=
        ~fired.descriptors;
    states_[state_named(fired.after)].word(fired.machine.subject, fired.first_word) |=
        fired.descriptors;
    return touch(fired.machine.subject);
  }
  if (fired.machine.machine == "HeartbeatTimer") {
    heartbeats_.transition(fired.machine, fired.event, fired.after);
    return touch_writer(fired.machine.subject);
  }
  if (fired.machine.machine != "DiscoveryReader") return;
  Relation& relation = relations_[fired.machine.subject];
  if (!relation.reader_open) relation.reader_open = fired.event == "AnnouncementReceived";
  if (!relation.heartbeat_seen) relation.heartbeat_seen = fired.event == "HeartbeatReceived";
  touch(fired.machine.subject);
}

Prospects::Load Prospects::load_of(const model::Packet& packet) {
  return {packet.kind,
          packet.pair,
          static_cast<std::uint32_t>(packet.stream),
          packet.kind == PacketKind::heartbeat || packet.carries_heartbeat,
          packet.initial_acknack,
          packet.from_repair,
          &packet.descriptors};
}

/// A packet begins to be on its way, or ends it.
void Prospects::move(const Load& load, std::uint32_t change) {
  switch (load.kind) {
    case PacketKind::spdp_multicast:
      add(participants_[load.pair].multicasts, change);
      return;
    case PacketKind::spdp_unicast:
      add(copies_[load.pair], change);
      return touch(2 * load.pair), touch(2 * load.pair + 1);
    case PacketKind::data:
      load.descriptors->for_each(
          [&](std::uint32_t d) { add(data_.at(load.relation(), d), change); });
      if (load.heartbeat) add(relations_[load.relation()].heartbeats, change);
      break;
    case PacketKind::heartbeat:
      add(relations_[load.relation()].heartbeats, change);
      break;
    case PacketKind::acknack:
      if (load.initial) add(relations_[load.relation()].initial_acknacks, change);
      if (load.initial && rules_.initial_acknack != model::InitialAckNackReply::bitmap) break;
      load.descriptors->for_each(
          [&](std::uint32_t d) { add(requests_.at(load.relation(), d), change); });
      break;
    default:
      return;
  }
  touch(load.relation());
}

/// A repair enters the source's backlog, or has left the source.
void Prospects::in_source(const Load& load, std::uint32_t change) {
  if (!load.from_repair) return;
  load.descriptors->for_each(
      [&](std::uint32_t d) { add(sources_.at(load.relation(), d), change); });
  touch(load.relation());
}

void Prospects::emitted(const model::Packet& packet, std::uint32_t source,
                        std::span<const std::uint32_t> destinations) {
  const bool of_writer = packet.kind == PacketKind::data || packet.kind == PacketKind::heartbeat;
  if (packet.to_nobody) {
    departing_ = {};
    return;
  }
  if (!constant_delay_) {
    Load load = load_of(packet);
    in_source(load, more);
    for (std::uint32_t copy = 0; copy < packet.copies; ++copy) {
      if (packet.copies > 1) load.pair = topology_->pair_between(source, destinations[copy]);
      if (of_writer) relations_[load.relation()].writer_open = true;
      if (!is_lost(packet.number + copy)) move(load, more);
    }
    return;
  }
  Departing next;
  next.load = load_of(packet);
  next.number = packet.number;
  if (packet.copies == 1) {
    next.pairs.push_back(packet.pair);
  } else {
    for (const std::uint32_t destination : destinations) {
      next.pairs.push_back(topology_->pair_between(source, destination));
    }
  }
  if (of_writer) {
    for (const std::uint32_t pair : next.pairs) {
      relations_[2 * pair + next.load.stream].writer_open = true;
    }
  }
  std::vector<std::uint64_t> words;
  for (std::uint32_t k = 0; !packet.descriptors.empty() && k < packet.descriptors.end_word(); ++k)
    words.push_back(packet.descriptors.word(k));
  next.descriptors = model::DescriptorSet{words};
  departing_ = std::move(next);
  departing_.load.descriptors = &departing_.descriptors;
  if (traits_.receives_separately && packet.multicast()) {  // a reception for each receiver
    departing_.pairs.resize(topology_->peer_count(source), packet.pair);
  }
}

void Prospects::source_completed(const model::Packet& packet) {
  if (traits_.waits_for_source) in_source(load_of(packet), less);
}

void Prospects::arrived(const model::Packet& packet, bool lost) {
  if (!is_lost(packet.number) && !packet.to_nobody) move(load_of(packet), less);
  delivered_ = traits_.receives_separately && !lost ? &packet : nullptr;
}

void Prospects::received(const model::Packet& packet, std::uint32_t receiver) {
  delivered_ = nullptr;
  if (!traits_.receives_separately || !crosses_hosts(*topology_, packet, receiver)) return;
  move(load_of(packet), less);
}

bool Prospects::is_lost(std::uint64_t number) const {
  return !lost_packets_.empty() &&
         std::binary_search(lost_packets_.begin(), lost_packets_.end(), number);
}

void Prospects::touch(std::uint32_t relation) {
  if (relations_[relation].touched) return;
  relations_[relation].touched = true;
  touched_.push_back(relation);
}

void Prospects::touch_writer(std::uint32_t writer) {
  const std::uint32_t end = topology_->first_pair(writer / 2 + 1);
  for (std::uint32_t pair = topology_->first_pair(writer / 2); pair < end; ++pair) {
    touch(2 * pair + writer % 2);
  }
}

void Prospects::touch_participant(std::uint32_t participant) {
  const std::uint32_t end = topology_->first_pair(participant + 1);
  for (std::uint32_t pair = topology_->first_pair(participant); pair < end; ++pair) {
    for (const std::uint32_t stream : {0U, 1U}) {
      touch(2 * pair + stream);
      touch(2 * topology_->pair(pair).reverse + stream);
    }
  }
}

void Prospects::touch_all() {
  for (std::uint32_t relation = 0; relation < relations_.size(); ++relation) touch(relation);
}

const std::vector<std::uint32_t>& Prospects::take_touched() {
  taken_.clear();
  taken_.swap(touched_);
  for (const std::uint32_t relation : taken_) relations_[relation].touched = false;
  return taken_;
}

}  // namespace stormproof::props
