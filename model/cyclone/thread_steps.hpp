// What the rules of Cyclone DDS leave to their host (fsm/composition/cyclone_parts.hpp): messages
// for the event threads and what these do with them, and which user topics match when. It is stated
// once for whoever executes the rules: the simulator, and the audit of its runs. `Host` says
//   run<Trigger>(n, m, d)   the rule of a trigger, for owner n
//   send_copy(i, to)   a copy of what thread i sends goes to a participant, or to the group
//   pauses(i)          whether the thread goes on later, after a copy
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

#include "fsm/composition/cyclone_life.hpp"
#include "model/cyclone/event_threads.hpp"
#include "model/engine/columns.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/running_world.hpp"

namespace stormproof::model::cyclone {

namespace rules = fsm::composition::cyclone;

/// How many writers a participant has, the deployment says; observers hear of them as endpoints.
struct Numbers : PlainColumns {
  template <Owner owner>
  static std::uint32_t rows(const RunState& run) {
    const std::uint32_t rows = PlainColumns::rows<owner>(run);
    const bool by_stream = (owner.indices & comp::owner::stream_index) != 0;
    return by_stream ? rows / 2 * writers_per_participant(run.topology) : rows;
  }
  static constexpr MachineRef::Kind kind(Owner owner) {
    if (owner == comp::owner::writer) return MachineRef::Kind::endpoint_writer;
    if (owner == comp::owner::relation) return MachineRef::Kind::endpoint_relation;
    return PlainColumns::kind(owner);
  }
};

/// `lives`: its participants have a life (model/cyclone/living_steps.hpp).
template <class Host, bool lives = false>
class ThreadSteps : public EventThreads {
 public:
  using EventThreads::EventThreads;

  void changed(rules::WriterOpen, Number r, bool matched) {
    if (matched) match(r);
  }
  /// Runs the rules of a packet that arrives; what arrives before its receiver listens is lost.
  void take_in(const Packet& packet, Number receiver);

  // What submessages say.
  [[nodiscard]] static bool said(comp::IsInitial, const Submessage& m) { return m.initial; }
  [[nodiscard]] static bool said(rules::IsDirected, const Submessage& m) { return m.directed; }
  [[nodiscard]] static std::int64_t said(rules::Count, const Submessage& m) { return m.count; }
  [[nodiscard]] static std::uint64_t word(comp::Carries, const Submessage& m, Number k) {
    return bits_below(m.sample + 1, k) & ~bits_below(m.sample, k);
  }
  [[nodiscard]] static std::uint64_t word(comp::Announces, const Submessage& m, Number k) {
    return bits_below(m.sample, k);
  }
  [[nodiscard]] static std::uint64_t word(comp::BelowBase, const Submessage& m, Number k) {
    return bits_below(m.sample, k);
  }
  [[nodiscard]] static std::uint64_t word(comp::Listed, const Submessage& m, Number k) {
    return m.bitmap.word(k);
  }

  // What only the host knows.
  [[nodiscard]] std::int64_t knob(rules::SendTime) const {
    return steps_of_.scenario.deployment.time_to_send().count();
  }
  template <class World>
  [[nodiscard]] bool answer(rules::IsQueued, const World& w) const {
    return is_queued(w.template number<comp::owner::relation>(), w.descriptor(), false);
  }
  template <class World>
  [[nodiscard]] bool answer(rules::IsQueuedForIt, const World& w) const {
    return is_queued(w.template number<comp::owner::relation>(), w.descriptor(), true);
  }
  template <class World>
  [[nodiscard]] bool answer(rules::QueueIsFull, const World& w) const {
    const auto i = w.template number<comp::owner::participant>();
    return threads_[i].queued_repairs >= steps_of_.profiles.of(i).sedp.max_queued_rexmit_messages;
  }
  template <class World>
  [[nodiscard]] bool answer(rules::AnswerIsKept, const World& w) const {
    const auto& kept = threads_[w.template number<comp::owner::participant>()].kept;
    return kept && kept->relation == w.template number<comp::owner::relation>();
  }
  template <class World>
  [[nodiscard]] bool answer(rules::SomeAnswerIsKept, const World& w) const {
    return threads_[w.template number<comp::owner::participant>()].kept.has_value();
  }

  // Packets: messages for the thread. What a timer gives goes into the packet that is open, all
  // else waits in the queue.
  template <class World, class Sayings>
  void emit(rules::Spdp, World& w, const Sayings&) {
    const Pair& pair = steps_of_.topology.pair(w.template number<comp::owner::pair>());
    Message m = announcement(pair.source);
    m.content.directed = true;
    m.to = Destination::only(pair.destination);
    enqueue(pair.source, std::move(m));
  }
  template <class World, class Sayings>
  void emit(rules::Data, World& w, const Sayings&) {
    const auto r = w.template number<comp::owner::relation>();
    Message m = data(writer_of(r), w.descriptor());
    m.to = Destination::only(ends_of(r).destination);
    m.retransmission = true;
    enqueue(ends_of(r).source, std::move(m));
  }
  template <class World, class Sayings>
  void emit(rules::Heartbeat, World& w, const Sayings& sayings) {
    const auto r = w.template number<comp::owner::relation>();
    Message m = heartbeat_now(writer_of(r), said_of<rules::IsDirected>(sayings));
    m.to = Destination::only(ends_of(r).destination);
    Thread& thread = threads_[ends_of(r).source];
    if (m.content.directed) {
      thread.kept = KeptAnswer{r, std::move(m)};
    } else {
      thread.given.push_back(std::move(m));
    }
  }
  template <class World, class... Sayings>
  void emit(rules::AckNack, World& w, const std::tuple<Sayings...>& sayings) {
    const auto r = w.template number<comp::owner::relation>();
    Submessage content;
    content.initial = (std::is_same_v<typename Sayings::Field, comp::IsInitial> || ...);
    if constexpr ((std::is_same_v<typename Sayings::Field, comp::Listed> || ...)) {
      content.bitmap = w.set_of(said_of<comp::Listed>(sayings));
    }
    if constexpr ((std::is_same_v<typename Sayings::Field, comp::BelowBase> || ...)) {
      content.sample = end_of(w.set_of(said_of<comp::BelowBase>(sayings)));
      content.count = said_of<rules::Count>(sayings);
    }
    Message m = acknack(r, std::move(content), host().template first<rules::Known>(r));
    m.to = Destination::only(ends_of(r).source);
    threads_[ends_of(r).destination].given.push_back(std::move(m));
  }

  // Opaque steps.
  template <class World>
  void perform(rules::HeartbeatToAll, World& w) {
    const auto n = w.template number<comp::owner::writer>();
    Message m = heartbeat_now(n, false);
    m.to = readers_of(n);
    threads_[n / stride_].given.push_back(std::move(m));
  }
  template <class World>
  void perform(rules::DataToAll, World& w) {
    const auto n = w.template number<comp::owner::writer>();
    Message m = data(n, w.descriptor());
    m.to = readers_of(n);
    enqueue(n / stride_, std::move(m));
  }
  template <class World>
  void perform(rules::Announce, World& w);
  template <class World>
  void perform(rules::SendToAllInstead, World& w) {
    send_to_all_instead(w.template number<comp::owner::relation>(), w.descriptor());
  }
  template <class World>
  void perform(rules::LetAnswerGo, World& w) {
    let_answer_go(w.template number<comp::owner::participant>());
  }
  template <class World>
  void perform(rules::Work, World& w) {
    work(w.template number<comp::owner::participant>());
  }
  template <class World>
  void perform(rules::JoinList, World& w, rules::AckTimer) {
    const auto r = w.template number<comp::owner::relation>();
    threads_[ends_of(r).destination].list.push_back({TimerKind::acknack, r});
  }
  template <class World>
  void perform(rules::JoinList, World& w, rules::HeartbeatTimer) {
    const auto n = w.template number<comp::owner::writer>();
    threads_[n / stride_].list.push_back({TimerKind::heartbeat, n});
  }
  template <class World>
  void perform(rules::JoinList, World& w, rules::SpdpTimer) {
    const auto i = w.template number<comp::owner::participant>();
    threads_[i].list.push_back({TimerKind::announcement, i});
  }
  template <class World>
  void perform(rules::JoinList, World& w, rules::ReplyTimer) {
    const auto pair = w.template number<comp::owner::pair>();
    threads_[steps_of_.topology.pair(pair).source].list.push_back({TimerKind::reply, pair});
  }
  /// After a notification or a creation, as the world's place says.
  template <class World>
  void perform(rules::OpenTopics, World& w) {
    if constexpr (World::place == comp::owner::descriptor) {
      open_notified(w.template number<comp::owner::relation>(), w.descriptor());
    } else {
      static_assert(World::place == comp::owner::entry);
      open_created(w.template number<comp::owner::writer>(), w.descriptor());
    }
  }

 protected:
  /// The sample of the liveliness writer is there from the beginning. For the host's constructor:
  /// before it there is no host to ask.
  void begin_liveliness() {
    for (Number i = 0; i < threads_.size(); ++i) {
      host().template set_first<rules::Exists>(stride_ * i + writer::liveliness, 1);
      host().template set_first<rules::Sent>(stride_ * i + writer::liveliness, 1);
    }
  }
  void create(Number i, Endpoint endpoint) {
    happen<rules::Created>(stride_ * i + slot_of(endpoint.stream), endpoint.descriptor);
  }
  /// Those of word k that the reader of relation r has only now, if discovery needs them.
  [[nodiscard]] std::uint64_t required(Number r, Number k, std::uint64_t received) const {
    if (r % stride_ > writer::subscriptions || !ends_of(r).cross_host) return 0;
    return received & ~host().word(comp::X{}, r, k);
  }

  [[nodiscard]] Host& host() { return static_cast<Host&>(*this); }
  [[nodiscard]] const Host& host() const { return static_cast<const Host&>(*this); }
  template <class Occasion>
  void happen(Number n, Number descriptor = 0) {
    host().template run<comp::Happens<Occasion>>(n, nullptr, descriptor);
  }
  /// Whether participant of writer w has the endpoint; whether the reader of relation r knows it.
  [[nodiscard]] bool owns(Number w, Number descriptor) const {
    return host().has(rules::Exists{}, w, descriptor);
  }
  [[nodiscard]] bool knows(Number r, Number descriptor) const {
    return host().has(rules::Notified{}, r, descriptor);
  }
  void open_created(Number w, Number descriptor);
  void open_notified(Number r, Number descriptor);
  void work(Number i);

 private:
  [[nodiscard]] Message heartbeat_now(Number w, bool directed) const {
    Message m = heartbeat(w, host().template first<rules::Exists>(w),
                          host().template at<rules::HeartbeatCount>(w), directed);
    if constexpr (lives) m.content.first = host().template first<rules::Gone>(w);
    return m;
  }
  void receive(const Submessage& m, Number sender, Number receiver);
  bool next_task(Thread& thread);
  void fire(const DueTimer& timer);
  void note_sent(Thread& thread);
};

template <class Host, bool lives>
void ThreadSteps<Host, lives>::take_in(const Packet& packet, Number receiver) {
  const Participant& p = steps_of_.scenario.deployment.participants[receiver];
  if (steps_of_.now < p.open.value_or(p.start)) return;
  const Topology& topology = steps_of_.topology;
  const Number sender = packet.multicast() ? packet.pair : topology.pair(packet.pair).source;
  if constexpr (lives) {
    happen<rules::PacketBegins>(topology.pair_between(sender, receiver));
  }
  for (const Submessage& m : *packet.submessages) {
    receive(m, sender, receiver);
    if (steps_of_.ends_now()) return;
  }
  happen<rules::PacketEnds>(receiver);
}

template <class Host, bool lives>
void ThreadSteps<Host, lives>::receive(const Submessage& m, Number sender, Number receiver) {
  const Topology& topology = steps_of_.topology;
  const Number pair = m.kind == Submessage::Kind::acknack ? topology.pair_between(receiver, sender)
                                                          : topology.pair_between(sender, receiver);
  const Number relation = stride_ * pair + m.writer;
  switch (m.kind) {
    case Submessage::Kind::spdp:
      return host().template run<comp::Received<rules::Spdp>>(pair, &m);
    case Submessage::Kind::data:
      return host().template run<comp::Received<rules::Data>>(relation, &m);
    case Submessage::Kind::heartbeat:
      return host().template run<comp::Received<rules::Heartbeat>>(relation, &m);
    case Submessage::Kind::acknack:
      return host().template run<comp::Received<rules::AckNack>>(relation, &m);
    case Submessage::Kind::gap:
      if constexpr (lives) host().template run<comp::Received<rules::Gap>>(relation, &m);
  }
}

template <class Host, bool lives>
template <class World>
void ThreadSteps<Host, lives>::perform(rules::Announce, World& w) {
  const auto i = w.template number<comp::owner::participant>();
  Message m = announcement(i);
  m.to.is_set = true;
  m.to.addresses.push_back(group);
  const Topology& topology = steps_of_.topology;
  for (Number pair = topology.first_pair(i); pair < topology.first_pair(i + 1) && !has_group(i);
       ++pair) {
    const Pair& ends = topology.pair(pair);
    if (host().value(comp::Recognised{}, ends.reverse)) m.to.addresses.push_back(ends.destination);
  }
  enqueue(i, std::move(m));
}

template <class Host, bool lives>
void ThreadSteps<Host, lives>::work(Number i) {
  Thread& thread = threads_[i];
  while (true) {
    if (!thread.left.empty()) {
      const Number to = thread.left.front();
      thread.left.pop_front();
      host().send_copy(i, to);
      if (!host().pauses(i)) continue;
      return happen<rules::ThreadPauses>(i);
    }
    thread.packer.open_held();
    if (thread.packer.is_complete()) {
      note_sent(thread);
      continue;
    }
    if (!next_task(thread)) {
      if (!thread.packer.has_open()) break;
      note_sent(thread);
      continue;
    }
    while (!thread.given.empty() && !thread.packer.is_complete()) {
      thread.packer.add(std::move(thread.given.front()));
      thread.given.pop_front();
    }
    if (thread.packer.is_complete()) note_sent(thread);
  }
  happen<rules::ThreadSleeps>(i);
}

/// Fires a timer, or takes the first message of the queue; false if there is neither.
template <class Host, bool lives>
bool ThreadSteps<Host, lives>::next_task(Thread& thread) {
  if (!thread.given.empty()) return true;  // only a mistake gives more than one message
  if (thread.list.empty()) return take_queued(thread);
  const DueTimer timer = thread.list.front();
  thread.list.pop_front();
  fire(timer);
  return true;
}

template <class Host, bool lives>
void ThreadSteps<Host, lives>::fire(const DueTimer& timer) {
  switch (timer.kind) {
    case TimerKind::acknack:
      return happen<rules::AckTimerFires>(timer.owner);
    case TimerKind::heartbeat:
      return happen<rules::HeartbeatTimerFires>(timer.owner);
    case TimerKind::announcement:
      return happen<rules::SpdpTimerFires>(timer.owner);
    case TimerKind::reply:
      return happen<rules::ReplyTimerFires>(timer.owner);
    case TimerKind::liveliness:
      if constexpr (lives) happen<rules::LivelinessTimerFires>(timer.owner);
      return;
    case TimerKind::address:
      if constexpr (lives) happen<rules::AddressTimerFires>(timer.owner);
  }
}

/// The packet that is filled is sent from now on.
template <class Host, bool lives>
void ThreadSteps<Host, lives>::note_sent(Thread& thread) {
  begin_to_send(thread);
  for (const Submessage& m : *thread.contents) {
    if (m.kind != Submessage::Kind::data) continue;
    const Number w = stride_ * m.participant + m.writer;
    const Number sent = host().template first<rules::Sent>(w);
    host().template set_first<rules::Sent>(w, std::max(sent, m.sample + 1));
  }
}

/// Participant i has created a descriptor: what it has been notified of is the peers' other side of
/// the topic.
template <class Host, bool lives>
void ThreadSteps<Host, lives>::open_created(Number w, Number descriptor) {
  const Stream s = stream_of(w % stride_);
  const Number topic = topic_writer(s, descriptor);
  if (topic == writer::none) return;
  const Topology& topology = steps_of_.topology;
  const Number i = w / stride_;
  for (Number pair = topology.first_pair(i); pair < topology.first_pair(i + 1); ++pair) {
    const Number reverse = topology.pair(pair).reverse;
    const Number told = stride_ * reverse + slot_of(other(s));
    if (!host().knows(told, descriptor_of(topic, other(s)))) continue;
    if (s == Stream::pub) {
      happen<rules::WriterOpens>(stride_ * pair + topic);
    } else {
      happen<comp::ReaderOpens>(stride_ * reverse + topic);
    }
  }
}

/// The reader of the relation has been notified of a descriptor.
template <class Host, bool lives>
void ThreadSteps<Host, lives>::open_notified(Number r, Number descriptor) {
  if (r % stride_ > writer::subscriptions) return;
  const Stream s = stream_of(r % stride_);
  const Number topic = topic_writer(s, descriptor);
  if (topic == writer::none) return;
  const Number own = stride_ * ends_of(r).destination + slot_of(other(s));
  if (!host().owns(own, descriptor_of(topic, other(s)))) return;
  if (s == Stream::pub) {
    happen<comp::ReaderOpens>(stride_ * (r / stride_) + topic);
  } else {
    happen<rules::WriterOpens>(stride_ * ends_of(r).reverse + topic);
  }
}

}  // namespace stormproof::model::cyclone
