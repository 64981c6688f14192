// The event thread of a participant: it fires timers, takes what is queued, packs both, and sends
// packets copy by copy. And the messages: what they carry, where they go, how much they weigh.
#include <algorithm>

#include "model/cyclone/protocol.hpp"

namespace stormproof::model::cyclone {

namespace {
constexpr std::uint32_t bits_per_word = 32;

/// Whether it was set before.
bool mark(std::vector<std::uint64_t>& bits, std::uint32_t d) {
  const std::uint64_t bit = std::uint64_t{1} << d % 64;
  const bool marked = (bits[d / 64] & bit) != 0;
  bits[d / 64] |= bit;
  return marked;
}
}  // namespace

void Protocol::work(Number i) {
  Participant& p = participants_[i];
  while (true) {
    if (!p.left.empty()) {
      send_copy(i);
      if (run_.scenario.deployment.time_to_send() == Nanoseconds{0} && !network_.stalls(i))
        continue;
      run_rule<comp::Happens<rules::ThreadPauses>>(*this, i);
      return;
    }
    p.packer.open_held();
    if (!next_task(i)) {
      if (!p.packer.has_open()) break;
      begin_to_send(i);
      continue;
    }
    while (!p.given.empty() && !p.packer.is_complete()) {
      p.packer.add(std::move(p.given.front()));
      p.given.pop_front();
    }
    if (p.packer.is_complete()) begin_to_send(i);
  }
  run_rule<comp::Happens<rules::ThreadSleeps>>(*this, i);
}

/// Fires a timer, or takes the first message of the queue; false if there is neither.
bool Protocol::next_task(Number i) {
  Participant& p = participants_[i];
  if (!p.given.empty()) return true;  // only a mistake gives more than one message
  if (!p.list.empty()) {
    const DueTimer timer = p.list.front();
    p.list.pop_front();
    fire(timer);
    return true;
  }
  if (p.queue.empty()) return false;
  if (p.queue.front().retransmission) --p.queued_repairs;
  p.given.push_back(std::move(p.queue.front()));
  p.queue.pop_front();
  return true;
}

void Protocol::fire(const DueTimer& timer) {
  switch (timer.kind) {
    case TimerKind::acknack:
      run_rule<comp::Happens<rules::AckTimerFires>>(*this, timer.owner);
      break;
    case TimerKind::heartbeat:
      run_rule<comp::Happens<rules::HeartbeatTimerFires>>(*this, timer.owner);
      break;
    case TimerKind::announcement:
      run_rule<comp::Happens<rules::SpdpTimerFires>>(*this, timer.owner);
      break;
    case TimerKind::reply:
      run_rule<comp::Happens<rules::ReplyTimerFires>>(*this, timer.owner);
      break;
  }
}

void Protocol::begin_to_send(Number i) {
  Participant& p = participants_[i];
  Bundle bundle = p.packer.take_open();
  for (const Submessage& m : bundle.contents) {
    if (m.kind != Submessage::Kind::data) continue;
    Number& sent = at<rules::Sent>(stride_ * m.participant + m.writer);
    sent = std::max(sent, m.sample + 1);
  }
  p.left.assign(bundle.to.addresses.begin(), bundle.to.addresses.end());
  p.bytes = bundle.bytes;
  p.contents = std::make_shared<const std::vector<Submessage>>(std::move(bundle.contents));
}

/// One packet; copies to the same host do not see the channel, and are not counted.
void Protocol::send_copy(Number i) {
  Participant& p = participants_[i];
  const Number to = p.left.front();
  p.left.pop_front();
  const bool to_group = to == group;
  const auto packet = [&] {
    model::Packet packet;
    packet.kind = PacketKind::rtps_message;
    packet.to_group = to_group;
    packet.pair = to_group ? i : run_.topology.pair_between(i, to);
    packet.payload_bytes = static_cast<Number>(p.bytes);
    packet.submessages = p.contents;
    return packet;
  };
  if (to_group) {
    for (Number pair = run_.topology.first_pair(i); pair < run_.topology.first_pair(i + 1);
         ++pair) {
      const Pair& ends = run_.topology.pair(pair);
      if (!ends.cross_host) network_.loop_back(packet(), ends.destination);
    }
  } else if (!run_.topology.pair(run_.topology.pair_between(i, to)).cross_host) {
    network_.loop_back(packet(), to);
    return;
  }
  model::Packet sent = packet();
  sent.use = TrafficClass::user_control;
  for (const Submessage& m : *p.contents) {
    const TrafficClass use = count(m, sent.pair, to_group);
    if (use == TrafficClass::initial_data) ++sent.initial_data;
    if (use == TrafficClass::repair_data) ++sent.repair_data;
    sent.use = std::min(sent.use, use);
  }
  sent.carries_initial = sent.initial_data > 0;
  network_.emit(i, std::move(sent));
}

/// What a submessage is for that is neither announcement nor DATA of a stream; it counts there.
TrafficClass Protocol::count_control(const Submessage& m, Counts& counts,
                                     std::uint64_t& user_control) {
  if (m.writer > writer::subscriptions) {
    ++user_control;
    return TrafficClass::user_control;
  }
  if (m.kind == Submessage::Kind::heartbeat) {
    ++counts.heartbeat;
    return TrafficClass::heartbeat;
  }
  ++counts.acknack;
  return TrafficClass::acknack;
}

/// Counts a submessage on its way to the destination of `pair`, or from participant `pair` to the
/// group; says what it is for.
TrafficClass Protocol::count(const Submessage& m, Number pair, bool to_group) {
  const bool later = counts_at_admission(run_);
  Counts of_no_interest;
  std::uint64_t control_of_no_interest = 0;
  Counts& counts = later ? of_no_interest : run_.counts;
  if (m.kind == Submessage::Kind::spdp) {
    ++(to_group ? counts.spdp_multicast : counts.spdp_unicast);
    return TrafficClass::spdp;
  }
  if (m.kind != Submessage::Kind::data || m.writer > writer::subscriptions) {
    return count_control(m, counts, later ? control_of_no_interest : run_.user_control);
  }
  auto& delivered = to_group ? writers_[stride_ * m.participant + m.writer].delivered
                             : delivered_[stride_ * pair + m.writer];
  const bool again = mark(delivered, m.sample);
  ++(again ? counts.repair_data : counts.initial_data);
  return again ? TrafficClass::repair_data : TrafficClass::initial_data;
}

void Protocol::count(const model::Packet& packet) {
  run_.counts.initial_data += packet.initial_data;
  run_.counts.repair_data += packet.repair_data;
  for (const Submessage& m : *packet.submessages) {
    if (m.kind == Submessage::Kind::spdp) {
      ++(packet.to_group ? run_.counts.spdp_multicast : run_.counts.spdp_unicast);
    } else if (m.kind != Submessage::Kind::data || m.writer > writer::subscriptions) {
      count_control(m, run_.counts, run_.user_control);
    }
  }
}

Destination Protocol::readers_of(Number w) const {
  const Writer& writer = writers_[w];
  Destination to{.is_set = true, .addresses = {}, .writer = w, .version = writer.version};
  if (multicast_ && writer.readers.size() > 1) {
    to.addresses.push_back(group);
    return to;
  }
  for (const Number r : writer.readers) to.addresses.push_back(ends(r).destination);
  return to;
}

/// A message about a writer of `owner`.
Message Protocol::message(Submessage&& content, Number owner, Number slot,
                          std::int64_t bytes) const {
  Message m;
  m.content = std::move(content);
  m.content.participant = owner;
  m.content.writer = slot;
  m.bytes = bytes;
  m.of_user = slot >= writer::first_topic;
  return m;
}

Message Protocol::heartbeat(Number w, bool directed) const {
  Submessage content;
  content.kind = Submessage::Kind::heartbeat;
  content.directed = directed;
  content.sample = first<rules::Exists>(w);
  content.count = at<rules::HeartbeatCount>(w);
  return message(std::move(content), w / stride_, w % stride_, heartbeat_bytes);
}

void Protocol::heartbeat_to(Number r, bool directed) {
  Message m = heartbeat(writer_of(r), directed);
  m.to = Destination::only(ends(r).destination);
  Participant& p = participants_[ends(r).source];
  if (directed) {
    p.kept = KeptAnswer{r, std::move(m)};
  } else {
    p.given.push_back(std::move(m));
  }
}

void Protocol::heartbeat_to_all(Number w) {
  Message m = heartbeat(w, false);
  m.to = readers_of(w);
  participants_[w / stride_].given.push_back(std::move(m));
}

void Protocol::let_answer_go(Number i) {
  std::optional<KeptAnswer>& kept = participants_[i].kept;
  if (!kept) return;
  enqueue(i, std::move(kept->message));
  kept.reset();
}

/// The bitmap ends at the last sample that is known to exist.
void Protocol::acknowledge(Number r, Submessage&& acknack) {
  const Number bits = acknack.bitmap.empty() ? 0 : first<rules::Known>(r) - acknack.sample;
  const Number words = (bits + bits_per_word - 1) / bits_per_word;
  Message m = message(std::move(acknack), ends(r).source, r % stride_,
                      acknack_bytes + bitmap_word_bytes * words);
  m.to = Destination::only(ends(r).source);
  participants_[ends(r).destination].given.push_back(std::move(m));
}

void Protocol::enqueue(Number i, Message&& m) {
  if (m.retransmission) ++participants_[i].queued_repairs;
  participants_[i].queue.push_back(std::move(m));
}

Message Protocol::data(Number w, Number sample) const {
  Submessage content;
  content.kind = Submessage::Kind::data;
  content.sample = sample;
  return message(std::move(content), w / stride_, w % stride_, data_bytes(w % stride_, sample));
}

void Protocol::push(Number w, Number sample) {
  Message m = data(w, sample);
  m.to = readers_of(w);
  enqueue(w / stride_, std::move(m));
}

void Protocol::repeat(Number r, Number sample) {
  Message m = data(writer_of(r), sample);
  m.to = Destination::only(ends(r).destination);
  m.retransmission = true;
  enqueue(ends(r).source, std::move(m));
}

const Message* Protocol::find_queued(Number r, Number sample, bool for_it) const {
  for (const Message& m : participants_[ends(r).source].queue) {
    if (!m.retransmission || m.content.sample != sample || m.content.writer != r % stride_) {
      continue;
    }
    if (!for_it || m.to.is_only(ends(r).destination)) return &m;
  }
  return nullptr;
}

void Protocol::send_to_all_instead(Number r, Number sample) {
  for (Message& m : participants_[ends(r).source].queue) {
    if (!m.retransmission || m.content.sample != sample || m.content.writer != r % stride_) {
      continue;
    }
    if (!m.to.is_set && !m.to.is_only(ends(r).destination)) m.to = readers_of(writer_of(r));
  }
}

Message Protocol::announcement(Number i) const {
  Submessage content;
  content.kind = Submessage::Kind::spdp;
  return message(std::move(content), i, 0,
                 multicast_ ? announcement_with_multicast_bytes : announcement_bytes);
}

void Protocol::announce(Number i) {
  Message m = announcement(i);
  m.to.is_set = true;
  m.to.addresses.push_back(group);
  for (Number pair = run_.topology.first_pair(i);
       pair < run_.topology.first_pair(i + 1) && !multicast_; ++pair) {
    const Pair& ends = run_.topology.pair(pair);
    if (at<comp::Recognised>(ends.reverse)) m.to.addresses.push_back(ends.destination);
  }
  enqueue(i, std::move(m));
}

void Protocol::announce_to(Number pair) {
  const Pair& ends = run_.topology.pair(pair);
  Message m = announcement(ends.source);
  m.content.directed = true;
  m.to = Destination::only(ends.destination);
  enqueue(ends.source, std::move(m));
}

}  // namespace stormproof::model::cyclone
