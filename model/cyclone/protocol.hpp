// Cyclone DDS 0.10 as a host of its rules (fsm/composition/cyclone*.hpp, specs/guide/cyclone.md):
// it keeps what they are about, and does the steps that they leave to a host. By source file:
//   protocol.cpp  events and packets to rules, user topics, what a descriptor's arrival means
//   sender.cpp    the event thread: what it fires, packs and sends; messages and their destinations
//   packer.cpp    which messages share a packet
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "fsm/composition/cyclone.hpp"
#include "model/cyclone/endpoints.hpp"
#include "model/cyclone/packer.hpp"
#include "model/engine/network.hpp"
#include "model/engine/running_world.hpp"
#include "model/engine/stored.hpp"
#include "model/engine/submessage.hpp"

namespace stormproof::model::cyclone {

namespace rules = fsm::composition::cyclone;

/// How many writers a participant has, the deployment says; observers hear of them as endpoints.
struct Columns : PlainColumns {
  using PlainColumns::column;
  // These hold for the first samples of a writer.
  static way::Prefix column(rules::Exists);
  static way::Prefix column(rules::Sent);
  static way::Prefix column(rules::Known);
  static way::Prefix column(rules::Notified);
  static way::Bits column(comp::X);

  template <Owner owner>
  static std::uint32_t rows(const RunState& run) {
    namespace own = comp::owner;
    if constexpr (owner == own::writer) {
      return writers_per_participant(run.topology) * run.topology.participant_count();
    } else if constexpr (owner == own::relation) {
      return writers_per_participant(run.topology) * run.topology.pair_count();
    } else {
      return PlainColumns::rows<owner>(run);
    }
  }
  static constexpr MachineRef::Kind kind(Owner owner) {
    if (owner == comp::owner::writer) return MachineRef::Kind::endpoint_writer;
    if (owner == comp::owner::relation) return MachineRef::Kind::endpoint_relation;
    return PlainColumns::kind(owner);
  }
};

class Protocol final : public Stored<Protocol, HostBase, ThingsOf<rules::Cyclone>, Columns,
                                     fsm::TypeList<rules::WriterOpen>> {
  using Number = std::uint32_t;

 public:
  using Composition = rules::Cyclone;
  using Packet = Submessage;  ///< rules receive submessages

  Protocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  /// Only the event thread sends.
  [[nodiscard]] std::optional<Number> sender_of(const Event& event) const override {
    if (event.kind != EventKind::thread_run) return {};
    return event.subject;
  }
  void count(const model::Packet& packet) override;
  void source_completed(const model::Packet&) override {}
  [[nodiscard]] bool receives_separately() const override { return true; }
  [[nodiscard]] std::vector<Number> receivers(const model::Packet& packet) const override;
  [[nodiscard]] std::optional<Nanoseconds> receives_later(Number receiver) const override;
  void received(const model::Packet& packet, Number receiver) override;
  void renew_bitmap(model::Packet&) override {}  // its bitmaps are in submessages
  [[nodiscard]] Number next_recipient(const model::Packet&, Number pair) const override {
    return pair;  // every packet stands for itself
  }
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

  // The host of a RunningWorld.
  [[nodiscard]] WriterLayout writer_layout() const { return {stride_, writer::first_topic}; }
  [[nodiscard]] Number samples_of(Number w) const;
  using Stored::knob;
  [[nodiscard]] std::int64_t knob(rules::SendTime) const {
    return run_.scenario.deployment.time_to_send().count();
  }

  // What is kept, and is more than a value.
  void changed(rules::WriterOpen, Number r, bool matched) {
    if (matched) match(r);
  }
  using Stored::assign_word;
  void assign_word(comp::X, Number r, Number k, std::uint64_t received) { take(r, k, received); }

  // Facts that are kept up to date.
  template <class World>
  [[nodiscard]] Number fact(rules::History, const World& w) const {
    return first<rules::Exists>(w.template number<comp::owner::writer>());
  }
  template <class World>
  [[nodiscard]] Number fact(rules::FirstMissing, const World& w) const {
    return first<comp::X>(w.template number<comp::owner::relation>()) + 1;
  }

  // What submessages say.
  using Stored::word;
  [[nodiscard]] bool said(comp::IsInitial, const Submessage& m) const { return m.initial; }
  [[nodiscard]] bool said(rules::IsDirected, const Submessage& m) const { return m.directed; }
  [[nodiscard]] std::int64_t said(rules::Count, const Submessage& m) const { return m.count; }
  [[nodiscard]] std::uint64_t word(comp::Carries, const Submessage& m, Number k) const {
    return bits_below(m.sample + 1, k) & ~bits_below(m.sample, k);
  }
  [[nodiscard]] std::uint64_t word(comp::Announces, const Submessage& m, Number k) const {
    return bits_below(m.sample, k);
  }
  [[nodiscard]] std::uint64_t word(comp::BelowBase, const Submessage& m, Number k) const {
    return bits_below(m.sample, k);
  }
  [[nodiscard]] std::uint64_t word(comp::Listed, const Submessage& m, Number k) const {
    return m.bitmap.word(k);
  }

  // What only the host knows.
  using Stored::answer;
  template <class World>
  [[nodiscard]] bool answer(rules::IsQueued, const World& w) const {
    return find_queued(w.template number<comp::owner::relation>(), w.descriptor(), false) !=
           nullptr;
  }
  template <class World>
  [[nodiscard]] bool answer(rules::IsQueuedForIt, const World& w) const {
    return find_queued(w.template number<comp::owner::relation>(), w.descriptor(), true) != nullptr;
  }
  template <class World>
  [[nodiscard]] bool answer(rules::QueueIsFull, const World& w) const {
    return participants_[w.template number<comp::owner::participant>()].queued_repairs >=
           sedp_.max_queued_rexmit_messages;
  }
  template <class World>
  [[nodiscard]] bool answer(rules::AnswerIsKept, const World& w) const {
    const auto& kept = participants_[w.template number<comp::owner::participant>()].kept;
    return kept && kept->relation == w.template number<comp::owner::relation>();
  }
  template <class World>
  [[nodiscard]] bool answer(rules::SomeAnswerIsKept, const World& w) const {
    return participants_[w.template number<comp::owner::participant>()].kept.has_value();
  }

  [[nodiscard]] const std::vector<Number>& readers(Number w) const { return writers_[w].readers; }

  // Packets: messages for the thread.
  template <class World, class... Sayings>
  void emit(rules::Spdp, World& w, const std::tuple<Sayings...>&) {
    announce_to(w.template number<comp::owner::pair>());
  }
  template <class World, class Sayings>
  void emit(rules::Data, World& w, const Sayings&) {
    repeat(w.template number<comp::owner::relation>(), w.descriptor());
  }
  template <class World, class Sayings>
  void emit(rules::Heartbeat, World& w, const Sayings& sayings) {
    heartbeat_to(w.template number<comp::owner::relation>(), said_of<rules::IsDirected>(sayings));
  }
  template <class World, class... Sayings>
  void emit(rules::AckNack, World& w, const std::tuple<Sayings...>& sayings) {
    Submessage acknack;
    acknack.kind = Submessage::Kind::acknack;
    acknack.initial = (std::is_same_v<typename Sayings::Field, comp::IsInitial> || ...);
    if constexpr ((std::is_same_v<typename Sayings::Field, comp::Listed> || ...)) {
      acknack.bitmap = w.set_of(said_of<comp::Listed>(sayings));
    }
    if constexpr ((std::is_same_v<typename Sayings::Field, comp::BelowBase> || ...)) {
      acknack.sample = end_of(w.set_of(said_of<comp::BelowBase>(sayings)));
      acknack.count = said_of<rules::Count>(sayings);
    }
    acknowledge(w.template number<comp::owner::relation>(), std::move(acknack));
  }

  // Opaque steps.
  template <class World>
  void perform(rules::HeartbeatToAll, World& w) {
    heartbeat_to_all(w.template number<comp::owner::writer>());
  }
  template <class World>
  void perform(rules::DataToAll, World& w) {
    push(w.template number<comp::owner::writer>(), w.descriptor());
  }
  template <class World>
  void perform(rules::Announce, World& w) {
    announce(w.template number<comp::owner::participant>());
  }
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
    const Number r = w.template number<comp::owner::relation>();
    join(ends(r).destination, {TimerKind::acknack, r});
  }
  template <class World>
  void perform(rules::JoinList, World& w, rules::HeartbeatTimer) {
    const Number n = w.template number<comp::owner::writer>();
    join(n / stride_, {TimerKind::heartbeat, n});
  }
  template <class World>
  void perform(rules::JoinList, World& w, rules::SpdpTimer) {
    const Number i = w.template number<comp::owner::participant>();
    join(i, {TimerKind::announcement, i});
  }
  template <class World>
  void perform(rules::JoinList, World& w, rules::ReplyTimer) {
    const Number pair = w.template number<comp::owner::pair>();
    join(run_.topology.pair(pair).source, {TimerKind::reply, pair});
  }
  /// After a notification or a creation, as the world's place says.
  template <Owner place>
  void perform(rules::OpenTopics, RunningWorld<Protocol, place>& w) {
    if constexpr (place == comp::owner::descriptor) {
      open_notified(w.template number<comp::owner::relation>(), w.descriptor());
    } else {
      static_assert(place == comp::owner::entry);
      open_created(w.template number<comp::owner::writer>(), w.descriptor());
    }
  }

 private:
  struct Writer {
    std::vector<Number> readers;           ///< relations, ascending
    std::uint64_t version = 0;             ///< how many matches there have been
    std::vector<std::uint64_t> delivered;  ///< samples that have been sent to the group
  };
  enum class TimerKind : std::uint8_t { acknack, heartbeat, announcement, reply };
  struct DueTimer {
    TimerKind kind{};
    Number owner = 0;
  };
  struct KeptAnswer {
    Number relation = 0;
    Message message;
  };
  struct Participant {
    explicit Participant(const SedpProfile& sedp) : packer{sedp} {}

    std::deque<DueTimer> list;
    std::deque<Message> given;  ///< what the timer that fires gives
    std::deque<Message> queue;
    std::uint32_t queued_repairs = 0;
    Packer packer;
    // What is being sent.
    std::shared_ptr<const std::vector<Submessage>> contents;
    std::deque<Number> left;  ///< addresses that it has not been sent to
    std::int64_t bytes = 0;
    std::optional<KeptAnswer> kept;
  };

  // protocol.cpp
  void match(Number relation);
  void take(Number relation, Number word, std::uint64_t received);
  void open_created(Number writer, Number sample);
  void open_notified(Number relation, Number sample);
  void receive(const Submessage& m, Number sender, Number receiver);

  // sender.cpp
  void work(Number i);
  bool next_task(Number i);
  void fire(const DueTimer& timer);
  void begin_to_send(Number i);
  void send_copy(Number i);
  TrafficClass count(const Submessage& m, Number pair, bool to_group);
  static TrafficClass count_control(const Submessage& m, Counts& counts,
                                    std::uint64_t& user_control);
  void join(Number i, DueTimer timer) { participants_[i].list.push_back(timer); }
  void enqueue(Number i, Message&& message);
  [[nodiscard]] Destination readers_of(Number writer) const;
  [[nodiscard]] Message message(Submessage&& content, Number owner, Number slot,
                                std::int64_t bytes) const;
  [[nodiscard]] Message heartbeat(Number writer, bool directed) const;
  [[nodiscard]] Message data(Number writer, Number sample) const;
  [[nodiscard]] Message announcement(Number i) const;
  void heartbeat_to(Number relation, bool directed);
  void heartbeat_to_all(Number writer);
  void acknowledge(Number relation, Submessage&& acknack);
  void push(Number writer, Number sample);
  void repeat(Number relation, Number sample);
  void announce(Number i);
  void announce_to(Number pair);
  void send_to_all_instead(Number relation, Number sample);
  void let_answer_go(Number i);
  [[nodiscard]] const Message* find_queued(Number relation, Number sample, bool for_it) const;

  [[nodiscard]] const Pair& ends(Number relation) const {
    return run_.topology.pair(relation / stride_);
  }
  [[nodiscard]] Number writer_of(Number relation) const {
    return stride_ * ends(relation).source + relation % stride_;
  }
  [[nodiscard]] static Number end_of(const DescriptorSet& set) {
    return set.empty() ? 0 : set.highest() + 1;
  }

  Network& network_;
  const SedpProfile& sedp_;
  const bool multicast_;
  const Number stride_;  ///< writers of each participant
  std::vector<Participant> participants_;
  std::vector<Writer> writers_;                        // stride · participant + writer
  std::vector<std::vector<std::uint64_t>> delivered_;  // by relation, stride · pair + writer:
                                                       // samples that have been sent by unicast
};

}  // namespace stormproof::model::cyclone
