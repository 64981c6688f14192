// What the rules of Cyclone DDS with a life leave to their host besides (fsm/composition/
// cyclone_life_parts.hpp), stated once for the simulator and for the audit of its runs: which
// samples are about which endpoints, addresses of announcements, what happens to participants
// when, and when discovery is complete. `Host` says what it says for ThreadSteps.
#pragma once

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "model/cyclone/address_schedule.hpp"
#include "model/cyclone/life_periods.hpp"
#include "model/cyclone/living_completion.hpp"
#include "model/cyclone/thread_steps.hpp"
#include "model/engine/endpoint_creations.hpp"

namespace stormproof::model::cyclone {

template <class Host>
class LivingSteps : public ThreadSteps<Host, true> {
  using Base = ThreadSteps<Host, true>;
  using Message = cyclone::Message;
  using typename Base::TimerKind;

 public:
  using Number = std::uint32_t;

  explicit LivingSteps(RunState& run)
      : Base{run},
        run_of_life_{run},
        addresses_{run.scenario},
        completion_{run, this->samples_},
        states_(run.topology.participant_count(), State::there) {}

  void changed(rules::WriterOpen, Number r, bool matched) {
    matched ? this->match(r) : this->unmatch(r);
  }
  /// Whether the participant has nothing to do with what is due or arrives.
  [[nodiscard]] bool is_gone(Number i) const { return states_[i] == State::gone; }
  [[nodiscard]] bool hears_packet(const Packet& packet, Number receiver) const {
    const Number sender =
        packet.multicast() ? packet.pair : this->steps_of_.topology.pair(packet.pair).source;
    return !is_gone(receiver) && hears(this->steps_of_.scenario.deployment, sender, receiver,
                                       packet.emitted, this->steps_of_.now);
  }
  /// Whether a timer of the participant still counts: of one that leaves only its thread goes on.
  [[nodiscard]] bool has_timers(Number i, EventKind kind) const {
    const bool is_leaving = states_[i] == State::leaving && kind != EventKind::thread_run;
    return !is_gone(i) && !is_leaving && !is_away(life(), i, this->steps_of_.now);
  }

  // What it has and knows.
  [[nodiscard]] bool owns(Number w, Number descriptor) const {
    const Number i = w / this->stride_;
    const Stream s = stream_of(w % this->stride_);
    const bool is_late = descriptor >= this->steps_of_.topology.descriptor_count(i, s);
    return descriptor < this->samples_.endpoints(i, s) && completion_.owns(i, s, descriptor) &&
           (is_late || this->host().has(rules::Exists{}, w, descriptor));
  }
  [[nodiscard]] bool knows(Number r, Number descriptor) const {
    const Stream s = stream_of(r % this->stride_);
    return descriptor < this->samples_.endpoints(this->ends_of(r).source, s) &&
           completion_.knows(r / this->stride_, s, descriptor);
  }

  using Base::said;
  using Base::word;
  [[nodiscard]] static bool said(rules::IsGoodbye, const Submessage& m) { return m.goodbye; }
  [[nodiscard]] static std::uint64_t word(rules::BelowFirst, const Submessage& m, Number k) {
    return bits_below(m.first, k);
  }
  [[nodiscard]] static std::uint64_t word(rules::Lists, const Submessage& m, Number k) {
    return m.bitmap.word(k);
  }

  using Base::answer;
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::LeaseDuration, const World& w) const {
    return lease_of_pair(w.template number<comp::owner::pair>());
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(rules::AnnouncingPeriod, const World& w) const {
    const auto i = w.template number<comp::owner::participant>();
    return announcing_period(dds(i), lease(i)).count();
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(rules::LivelinessPeriod, const World& w) const {
    constexpr bool of_writer = World::place != comp::owner::participant;
    Number i = 0;
    if constexpr (of_writer) {
      i = w.template number<comp::owner::writer>() / this->stride_;
    } else {
      i = w.template number<comp::owner::participant>();
    }
    return base_period(lease(i)).count();
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(rules::RepliesDue, const World& w) const {
    const auto i = w.template number<comp::owner::participant>();
    return replies_due(dds(i), lease(i));
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(rules::PreEmptiveInterval, const World& w) const {
    const auto r = w.template number<comp::owner::relation>();
    return preemptive_interval(this->steps_of_.now.count() -
                               this->host().template at<rules::OpenedAt>(r));
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(rules::NextAddress, const World& w) const {
    return addresses_.next(w.template number<comp::owner::participant>());
  }

  // Packets.
  using Base::emit;
  template <class World, class Sayings>
  void emit(rules::Gap, World& w, const Sayings& sayings) {
    const auto r = w.template number<comp::owner::relation>();
    this->enqueue(this->ends_of(r).source, this->gap(r, w.set_of(said_of<rules::Lists>(sayings))));
  }

  // Opaque steps.
  using Base::perform;
  template <class World>
  void perform(rules::LeaveList, World& w) {
    const auto r = w.template number<comp::owner::relation>();
    std::erase_if(this->threads_[this->ends_of(r).destination].list, [&](const auto& timer) {
      return timer.kind == TimerKind::acknack && timer.owner == r;
    });
  }
  template <class World>
  void perform(rules::JoinList, World& w, rules::LivelinessTimer) {
    const auto i = w.template number<comp::owner::participant>();
    this->threads_[i].list.push_back({TimerKind::liveliness, i});
  }
  template <class World>
  void perform(rules::JoinList, World& w, rules::AddressTimer) {
    const auto i = w.template number<comp::owner::participant>();
    this->threads_[i].list.push_back({TimerKind::address, i});
  }
  template <class World>
  void perform(rules::DropAcknowledged, World& w) {
    drop_acknowledged(w.template number<comp::owner::writer>());
  }
  template <class World>
  void perform(rules::CloseAllTopics, World& w) {
    const auto pair = w.template number<comp::owner::pair>();
    const Number reverse = this->steps_of_.topology.pair(pair).reverse;
    for (Number slot = writer::first_topic; slot < this->stride_; ++slot) {
      this->template happen<rules::ReaderCloses>(this->stride_ * pair + slot);
      this->template happen<rules::WriterCloses>(this->stride_ * reverse + slot);
    }
    completion_.forget(pair);
  }
  template <class World>
  void perform(rules::CloseTopics, World& w) {
    close_deleted(w.template number<comp::owner::writer>(), w.descriptor());
  }
  template <class World>
  void perform(rules::OpenTopics, World& w) {
    static_assert(World::place == comp::owner::entry);
    const auto n = w.template number<comp::owner::writer>();
    const Stream s = stream_of(n % this->stride_);
    this->open_created(n, this->samples_.of(n / this->stride_, s, w.descriptor()).descriptor);
  }
  template <class World>
  void perform(rules::FollowEndpoint, World& w) {
    follow(w.template number<comp::owner::relation>(), w.descriptor());
  }
  template <class World>
  void perform(rules::KeepAddress, World& w) {
    const Pair& ends = this->steps_of_.topology.pair(w.template number<comp::owner::pair>());
    addresses_.recognised(ends.destination, ends.source);
    completion_.recognise(w.template number<comp::owner::pair>());
  }
  template <class World>
  void perform(rules::LetAddressAge, World& w) {
    const Pair& ends = this->steps_of_.topology.pair(w.template number<comp::owner::pair>());
    addresses_.lease_ended(ends.destination, ends.source, this->steps_of_.now.count());
    ++run_of_life_.forgotten;
  }
  template <class World>
  void perform(rules::DropAddress, World& w) {
    const Pair& ends = this->steps_of_.topology.pair(w.template number<comp::owner::pair>());
    addresses_.said_goodbye(ends.destination, ends.source, this->steps_of_.now.count());
  }
  template <class World>
  void perform(rules::Announce, World& w) {
    const auto i = w.template number<comp::owner::participant>();
    announce(i, addresses_.of_announcement(i, false), false);
  }
  template <class World>
  void perform(rules::AnnounceEverywhere, World& w) {
    const auto i = w.template number<comp::owner::participant>();
    addresses_.start(i, this->steps_of_.now.count());
    announce(i, addresses_.of_announcement(i, true), false);
  }
  template <class World>
  void perform(rules::SayGoodbye, World& w) {
    const auto i = w.template number<comp::owner::participant>();
    announce(i, addresses_.of_announcement(i, true), true);
  }
  template <class World>
  void perform(rules::AgeAddresses, World& w) {
    const auto i = w.template number<comp::owner::participant>();
    announce(i, addresses_.age(i, this->steps_of_.now.count()), false);
  }
  template <class World>
  void perform(rules::LoseTimers, World& w) {
    const auto i = w.template number<comp::owner::participant>();
    this->threads_[i].list.clear();
    states_[i] = State::leaving;
    completion_.die(i);
  }
  template <class World>
  void perform(rules::WriteLiveliness, World& w) {
    const Number n =
        this->stride_ * w.template number<comp::owner::participant>() + writer::liveliness;
    this->template happen<rules::LivelinessWritten>(n,
                                                    this->host().template first<rules::Exists>(n));
  }
  template <class World>
  void perform(rules::SayLiveliness, World& w) {
    const auto n = w.template number<comp::owner::writer>();
    Message m = this->data(n, w.descriptor());
    m.to = this->readers_of(n);
    this->threads_[n / this->stride_].given.push_back(std::move(m));
  }
  template <class World>
  void perform(rules::CompletePacket, World& w) {
    const auto n = w.template number<comp::owner::writer>();
    this->threads_[n / this->stride_].given.back().completes = true;
  }
  template <class World>
  void perform(rules::LivingWork, World& w) {
    const auto i = w.template number<comp::owner::participant>();
    this->work(i);
    using Thread = fsm::Reflect<fsm::EventThread>;
    const bool is_idle =
        this->host().state(rules::Thread{}, i) == Thread::template id<fsm::event_thread::Asleep>;
    if (states_[i] == State::leaving && is_idle) states_[i] = State::gone;
  }

 protected:
  /// An endpoint that it has from the beginning, or something that happens later: what was
  /// scheduled k-th.
  void change(Number i, Number k) {
    const Topology& topology = this->steps_of_.topology;
    const Number at_start =
        topology.descriptor_count(i, Stream::pub) + topology.descriptor_count(i, Stream::sub);
    if (k < at_start) {
      if (has_timers(i, EventKind::endpoint_creation)) {
        this->create(i, creation_of(topology, i, k));
      }
      return;
    }
    const Change& change = this->samples_.changes(i)[k - at_start];
    const Number w = this->stride_ * i + slot_of(change.stream);
    switch (change.kind) {
      case Change::Kind::creates:
        completion_.create(i, change.stream, change.sample);
        return this->template happen<rules::Created>(w, change.sample);
      case Change::Kind::deletes:
        completion_.remove(i, change.stream, change.sample);
        return this->template happen<rules::Deleted>(w, change.sample);
      case Change::Kind::leaves:
        return this->template happen<rules::Leaves>(i);
      case Change::Kind::dies:
        states_[i] = State::gone;
        completion_.die(i);
    }
  }
  [[nodiscard]] const LivingCompletion& completion() const { return completion_; }
  [[nodiscard]] const AddressSchedule& addresses() const { return addresses_; }

 private:
  enum class State : std::uint8_t { there, leaving, gone };

  [[nodiscard]] const Life& life() const { return *this->steps_of_.scenario.deployment.life; }
  [[nodiscard]] const DdsProfile& dds(Number i) const { return this->steps_of_.profiles.of(i); }
  [[nodiscard]] Nanoseconds lease(Number i) const {
    return model::lease_of(life(), i).value_or(model::lease_of(dds(i)));
  }
  [[nodiscard]] std::int64_t lease_of_pair(Number pair) const {
    return lease(this->steps_of_.topology.pair(pair).source).count();
  }
  void announce(Number i, std::vector<Number> addresses, bool goodbye) {
    if (addresses.empty()) return;
    Message m = this->announcement(i);
    m.content.goodbye = goodbye;
    if (goodbye) m.bytes = timestamp_bytes + deletion_bytes;
    m.to.is_set = true;
    m.to.addresses = std::move(addresses);
    this->enqueue(i, std::move(m));
  }
  /// The writer of a descriptor's topic, or none: a topic that nobody ever publishes has no sides.
  [[nodiscard]] Number sided_topic(Stream s, Number descriptor) const {
    const Number topic = topic_writer(s, descriptor);
    return topic < this->stride_ ? topic : writer::none;
  }
  void drop_acknowledged(Number w);
  void close_deleted(Number w, Number sample);
  void follow(Number r, Number sample);

  RunState& run_of_life_;
  AddressSchedule addresses_;
  LivingCompletion completion_;
  std::vector<State> states_;
};

/// The samples about deletions that all readers have acknowledged exist no more.
template <class Host>
void LivingSteps<Host>::drop_acknowledged(Number w) {
  const Number slot = w % this->stride_;
  if (slot > writer::subscriptions) return;
  const Number i = w / this->stride_;
  std::int64_t all_have = this->host().template first<rules::Exists>(w);
  for (const Number r : this->readers(w)) {
    all_have = std::min(all_have, this->host().value(rules::Acked{}, r));
  }
  for (Number sample = 0; sample < all_have; ++sample) {
    if (!this->samples_.of(i, stream_of(slot), sample).deletes) continue;
    if (!this->host().has(rules::Gone{}, w, sample)) {
      this->host().assign(rules::Gone{}, w, sample, true);
    }
  }
}

/// At its own participant: a publication's writer loses all readers, a subscription's reader sides
/// close.
template <class Host>
void LivingSteps<Host>::close_deleted(Number w, Number sample) {
  const Number i = w / this->stride_;
  const Stream s = stream_of(w % this->stride_);
  const Number descriptor = this->samples_.of(i, s, sample).descriptor;
  for (Number d = 0; d < sample; ++d) {
    const Sample before = this->samples_.of(i, s, d);
    if (before.descriptor == descriptor) this->host().assign(rules::Gone{}, w, d, true);
  }
  const Number topic = sided_topic(s, descriptor);
  if (topic == writer::none) return;
  const Topology& topology = this->steps_of_.topology;
  for (Number pair = topology.first_pair(i); pair < topology.first_pair(i + 1); ++pair) {
    if (s == Stream::pub) {
      this->template happen<rules::WriterCloses>(this->stride_ * pair + topic);
    } else {
      this->template happen<rules::ReaderCloses>(this->stride_ * topology.pair(pair).reverse +
                                                 topic);
    }
  }
}

/// The reader has been notified of an endpoint, or of its deletion.
template <class Host>
void LivingSteps<Host>::follow(Number r, Number sample) {
  if (r % this->stride_ > writer::subscriptions) return;
  const Pair& ends = this->ends_of(r);
  const Stream s = stream_of(r % this->stride_);
  const Sample said = this->samples_.of(ends.source, s, sample);
  const Number pair = r / this->stride_;
  completion_.follow(pair, s, said);
  if (!said.deletes) return this->open_notified(r, said.descriptor);
  const Number topic = sided_topic(s, said.descriptor);
  if (topic == writer::none) return;
  if (s == Stream::pub) {
    this->template happen<rules::ReaderCloses>(this->stride_ * pair + topic);
  } else {
    this->template happen<rules::WriterCloses>(this->stride_ * ends.reverse + topic);
  }
}

}  // namespace stormproof::model::cyclone
