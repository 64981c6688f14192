// Fast DDS 2.6.11 as a host of its rules (fsm/composition/fastdds.hpp, specs/guide/fastdds.md): it
// keeps what they are about, and does the steps that they leave to a host. By source file:
//   protocol.cpp  state, events and packets to rules, what goes out on the wire
//   sender.cpp    messages: packing, piggyback, flushing
//   lookups.cpp   messages that ask for types, and answer
//   control.cpp   relations of which only the control traffic is modelled
// What the paper's implementation does alike is in model/engine/discovery_base.hpp.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "fsm/composition/fastdds.hpp"
#include "model/engine/discovery_base.hpp"
#include "model/engine/packet_tags.hpp"
#include "model/engine/relation_bits.hpp"
#include "model/engine/running_world.hpp"
#include "model/fastdds/lookups.hpp"
#include "model/fastdds/message.hpp"

namespace stormproof::model::fastdds {

/// How many readers the writer had matched before, if it forgets nobody.
struct Rank : comp::Number<comp::owner::relation> {};

struct Columns : PlainColumns {
  using PlainColumns::column;
  // These hold for the first descriptors of a stream.
  static way::Prefix column(rules::Exists);
  static way::Prefix column(rules::Known);
  static way::Prefix column(rules::HandedOver);
  static way::Elsewhere column(rules::WaitsForType);  // in lists
  static way::Capped column(control::ControlLastDelay);
  static way::Narrow column(Rank);

  template <Owner owner>
  static std::uint32_t rows(const RunState& run) {
    if constexpr (owner == comp::owner::control_relation) {
      return ControlRelations{run.topology, run.scenario}.count();
    } else if constexpr (owner == comp::owner::control_writer) {
      return control_writers * run.topology.participant_count();
    } else {
      return PlainColumns::rows<owner>(run);
    }
  }
};
using Things = comp::Joined<ThingsBeside<rules::FastDds, DiscoveryBase>, fsm::TypeList<Rank>>;

class Protocol : public Stored<Protocol, DiscoveryBase, Things, Columns,
                               fsm::TypeList<rules::WriterOpen, comp::X, lookup::GetsSamples>>,
                 public ControlSteps<Protocol> {
 public:
  using Composition = rules::FastDds;

  Protocol(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  [[nodiscard]] std::optional<std::uint32_t> sender_of(const Event& event) const override;
  void count(const Packet& packet) override;
  void source_completed(const Packet&) override {}  // suppression runs from serialization
  [[nodiscard]] bool receives_separately() const override { return true; }
  [[nodiscard]] std::vector<std::uint32_t> receivers(const Packet& packet) const override;
  void received(const Packet& packet, std::uint32_t receiver) override;
  void renew_bitmap(Packet& acknack) override;
  [[nodiscard]] std::uint32_t next_recipient(const Packet& heartbeat,
                                             std::uint32_t pair) const override;
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

  // The host of a RunningWorld.
  /// Of an ACKNACK: what is below its base, then what is listed.
  static constexpr auto lane_order(rules::C) { return std::array{false, true}; }

  [[nodiscard]] const std::vector<std::uint32_t>& readers_of_control(std::uint32_t writer) const {
    return writers_[lookup_writer(writer)].readers;
  }
  using ControlSteps::answer;
  using ControlSteps::perform;
  using DiscoveryBase::answer;
  using DiscoveryBase::emit;
  using DiscoveryBase::fact;
  using DiscoveryBase::perform;
  using Stored::word;
  template <class World>
  [[nodiscard]] bool answer(rules::CrossHost, const World& w) const {
    return run_.topology.pair(w.template number<comp::owner::pair>()).cross_host;
  }
  /// The relation's reader has these now. Another way to discover does it in its own way.
  virtual void take_descriptors(std::uint32_t relation, const DescriptorSet& received);
  using ControlSteps::assign;
  using Stored::assign;
  void changed(lookup::GetsSamples, std::uint32_t relation, bool) {
    writers_[lookup_writer(control_.writer_of(relation))].readers.push_back(relation);
  }
  void changed(rules::WriterOpen, std::uint32_t relation, bool matched) {
    std::vector<std::uint32_t>& readers = writers_[writer_of(relation)].readers;
    at<Rank>(relation) = static_cast<std::uint32_t>(readers.size());
    matched ? readers.push_back(relation) : static_cast<void>(std::erase(readers, relation));
  }
  template <class World>
  [[nodiscard]] bool fact(rules::QueueNotEmpty, const World& w) const {
    return !participants_[w.template number<comp::owner::participant>()].queue.empty();
  }
  template <class World>
  [[nodiscard]] bool fact(rules::HasDescriptors, const World& w) const {
    return first<rules::Exists>(w.template number<comp::owner::writer>()) > 0;
  }
  template <class World>
  [[nodiscard]] bool fact(rules::HasReaders, const World& w) const {
    return !writers_[w.template number<comp::owner::writer>()].readers.empty();
  }
  // Packets.
  [[nodiscard]] std::uint64_t word(comp::Announces, const Packet& packet, std::uint32_t k) const {
    return bits_below(packet.detail, k);
  }
  [[nodiscard]] std::uint64_t word(comp::BelowBase, const Packet& packet, std::uint32_t k) const {
    return bits_below(packet.detail, k);
  }
  using ControlSteps::said;
  using DiscoveryBase::said;
  template <class World, class Sayings>
  void emit(rules::Heartbeat, World& w, const Sayings& sayings) {
    send_heartbeat(w.template number<comp::owner::relation>(),
                   end_of(w.set_of(said_of<comp::Announces>(sayings))), heartbeat_to_one_bytes);
  }
  template <class World, class... Sayings>
  void emit(rules::AckNack, World& w, const std::tuple<Sayings...>& sayings) {
    constexpr bool initial = (std::is_same_v<typename Sayings::Field, comp::IsInitial> || ...);
    const std::uint32_t relation = w.template number<comp::owner::relation>();
    Packet packet = packet_on(PacketKind::acknack, relation, acknack_bytes);
    packet.initial_acknack = initial;
    if constexpr (!initial) fill(packet, w, sayings);
    send_acknack(std::move(packet));
  }
  template <class World, class Sayings>
  void emit(control::UserHeartbeat, World& w, const Sayings& sayings) {
    send_control(PacketKind::user_heartbeat, w.template number<comp::owner::control_relation>(),
                 false, static_cast<std::uint32_t>(said_of<lookup::SampleCount>(sayings)));
  }
  template <class World, class... Sayings>
  void emit(control::UserAckNack, World& w, const std::tuple<Sayings...>& sayings) {
    constexpr bool initial = (std::is_same_v<typename Sayings::Field, comp::IsInitial> || ...);
    std::uint32_t last_sample = 0;
    if constexpr (!initial) {
      last_sample = static_cast<std::uint32_t>(said_of<lookup::SampleCount>(sayings));
    }
    send_control(PacketKind::user_acknack, w.template number<comp::owner::control_relation>(),
                 initial, last_sample);
  }

  // Loops and opaque steps.
  [[nodiscard]] const std::vector<std::uint32_t>& readers(std::uint32_t w) const {
    return writers_[w].readers;
  }
  template <class Visit>
  void for_queue(std::uint32_t i, Visit&& visit) {
    std::deque<Endpoint>& queue = participants_[i].queue;
    if (std::exchange(participants_[i].is_suspended, false)) return;
    go_on(i);
    while (!queue.empty()) {
      const Endpoint entry = queue.front();
      queue.pop_front();
      visit(2 * i + static_cast<std::uint32_t>(entry.stream), entry.descriptor);
      if (!queue.empty() && network_.stalls(i)) return suspend(i);
    }
  }
  template <class World>
  void perform(rules::HeartbeatToAll, World& w) {
    send_heartbeat_to_all(w.template number<comp::owner::writer>());
  }
  template <class World>
  void perform(rules::Clock::SendBatch, World& w) {
    send_next_batch<rules::Implementation>(w);
  }
  template <class World>
  void perform(rules::Enqueue, World& w, const DescriptorSet& requested) {
    enqueue(w.template number<comp::owner::writer>(), requested);
  }
  template <class World>
  void perform(rules::Pack, World& w, rules::ToAll) {
    const std::uint32_t writer = w.template number<comp::owner::writer>();
    pack(sync_message_, writer, w.descriptor(), writers_[writer].readers, SendMode::sync);
  }
  template <class World>
  void perform(rules::Pack, World& w, rules::ToRequesters) {
    targets_.clear();
    w.for_readers([&](auto& r) {
      if (!rules::ToRequesters::serves(r)) return;
      targets_.push_back(r.template number<comp::owner::relation>());
    });
    pack(async_message_, w.template number<comp::owner::writer>(), w.descriptor(), targets_,
         SendMode::async);
  }
  template <class World, class To>
  void perform(rules::Charge, World& w, To) {
    constexpr SendMode mode = To::repairs ? SendMode::async : SendMode::sync;
    charge(message(mode), bytes_of(message(mode).writer, w.descriptor()), mode);
  }
  template <class World, class To>
  void perform(rules::Flush, World&, To) {
    constexpr SendMode mode = To::repairs ? SendMode::async : SendMode::sync;
    flush(message(mode), mode);
  }
  // What asks for types, and answers.
  template <class World>
  void perform(lookup::SendSamples, World& w) {
    const auto i = w.template number<comp::owner::participant>();
    go_on(i);
    while (lookups_.has_queued(i)) {
      send_sample(w, i);
      const bool is_done = !lookups_.has_queued(i) && participants_[i].queue.empty();
      if (is_done || !network_.stalls(i)) continue;
      participants_[i].is_suspended = true;
      return suspend(i);
    }
  }
  template <class World>
  void perform(lookup::PackSample, World& w) {
    targets_.clear();
    w.for_readers([&](auto& r) {
      if (!r(lookup::GoesToReader{})) return;
      targets_.push_back(r.template number<comp::owner::control_relation>());
    });
    pack_sample(lookup_writer(w.template number<comp::owner::control_writer>()), targets_);
  }
  template <class World>
  void perform(lookup::ChargeSample, World& w) {
    charge_sample(lookup_writer(w.template number<comp::owner::control_writer>()));
  }
  template <class World>
  void perform(lookup::LookupHeartbeatToAll, World& w) {
    send_lookup_heartbeats(lookup_writer(w.template number<comp::owner::control_writer>()));
  }
  template <class World>
  void perform(lookup::RefillLookupBudget, World& w) {
    refill(lookup_writer(w.template number<comp::owner::control_writer>()));
  }
  /// After a recognition, a notification or a creation, as the world's place says.
  template <class World>
  void perform(control::OpenTopics, World& w) {
    constexpr Owner place = World::place;
    const std::uint32_t d = w.descriptor();
    if constexpr (place == comp::owner::pair) {
      open_builtin(w.template number<comp::owner::pair>());
    } else if constexpr (place == comp::owner::descriptor) {
      const std::uint32_t relation = w.template number<comp::owner::relation>();
      note_notified(relation, d);
      if (!run_.ends_now()) open_notified(relation / 2, stream_of(relation), d);
    } else {
      static_assert(place == comp::owner::entry);
      const std::uint32_t writer = w.template number<comp::owner::writer>();
      open_created(writer / 2, stream_of(writer), d);
    }
  }

 protected:
  [[nodiscard]] auto& changes() { return planes(); }
  [[nodiscard]] const auto& changes() const { return planes(); }
  /// Where messages count that are generated.
  [[nodiscard]] Counts& generated() { return generated_; }

  // What another way to discover does in its own way.
  /// What an ACKNACK says besides.
  virtual void complete_acknack(Packet&) {}
  /// Announcement 0 of participant i.
  virtual void begin_announcing(std::uint32_t i) { start_announcing(i); }
  [[nodiscard]] virtual bool is_notified(std::uint32_t pair, Stream s, std::uint32_t d) const;
  /// Of a descriptor of the writer.
  [[nodiscard]] std::int64_t bytes_of(std::uint32_t writer, std::uint32_t d) const {
    const Own& own = own_of(writer / 2);
    return (traits_of(own.dds).has_server ? own.sizes.inline_qos : 0) +
           submessage_bytes(own.dds, stream_of(writer), d);
  }
  // Every packet has what the statistics module of its sender adds.
  void send_across(std::uint32_t from, Packet&& packet) {
    packet.payload_bytes += own_of(from).statistics_bytes;
    network_.emit(from, std::move(packet));
  }
  template <class P>
  void send_on_host(std::uint32_t from, P&& packet, std::uint32_t to) {
    std::remove_cvref_t<P> carried{std::forward<P>(packet)};
    carried.payload_bytes += own_of(from).statistics_bytes;
    network_.loop_back(std::move(carried), to);
  }
  /// Sends a unicast packet by the channel, or by loopback if both ends are on one host.
  void send(Packet&& packet);
  void open_builtin(std::uint32_t pair);
  void open_notified(std::uint32_t pair, Stream s, std::uint32_t d);

  void refill(std::uint32_t writer) override;
  /// The endpoint of a creation.
  [[nodiscard]] Endpoint created_by(const Event& event);
  /// Creations and receptions by the rules of the host, which is this.
  template <class Host>
  static void create(Host& host, const Event& event);
  template <class Host>
  static void take_in(Host& host, const Packet& packet, std::uint32_t receiver);

  struct Writer {
    std::int64_t budget = 0;             ///< piggyback budget, bytes
    std::uint64_t group_number = 0;      ///< of the participant when it last sent a HEARTBEAT
    std::vector<std::uint32_t> readers;  ///< M: relations in match order
  };
  struct Participant {
    std::deque<Endpoint> queue;   ///< what the async run will send
    std::int64_t sent_bytes = 0;  ///< all bytes that the async sender has ever sent
    // With `piggyback: group`: how often what it sent has exceeded the threshold, and since then.
    std::uint64_t group_number = 0;
    std::int64_t group_bytes = 0;
    Message unfinished;           ///< that of an async run which stalls, if it is open
    bool is_suspended = false;    ///< it stalls now, before it comes to descriptors
    std::uint32_t endpoints = 0;  ///< created so far, of a participant that may stall
  };
  /// What follows from the profile of a participant.
  struct Own {
    Own(const Scenario& scenario, const DdsProfile& profile)
        : dds{deployed_profile(scenario, profile)},
          sizes{sizes_of(dds)},
          statistics_bytes{static_cast<std::uint32_t>(dds.version.statistics_bytes.count())} {}

    DdsProfile dds;  ///< with what descriptors say of types
    const VersionSizes& sizes;
    std::uint32_t statistics_bytes;
  };
  [[nodiscard]] const Own& own_of(std::uint32_t participant) const {
    return own_[run_.profiles.number_of(participant)];
  }
  [[nodiscard]] const SedpProfile& sedp_of(std::uint32_t participant) const {
    return own_of(participant).dds.sedp;
  }
  std::vector<Own> own_;  // by number of the profile
  const std::uint32_t first_lookup_writer_;
  std::vector<Participant> participants_;
  /// 2 · participant + stream, then, from `first_lookup_writer_` on, those of questions, answers
  /// and other control-only topics.
  std::vector<Writer> writers_;

 private:
  // protocol.cpp
  [[nodiscard]] std::vector<std::uint32_t> open_relations(std::uint32_t writer) const override;
  void enqueue(std::uint32_t writer, const DescriptorSet& requested);
  void send_spdp_to_known(std::uint32_t i) override;
  void send_spdp_multicast(std::uint32_t i) override;
  void send_spdp_copy(std::uint32_t pair) override;
  void send_heartbeat(std::uint32_t relation, std::uint32_t announced, std::int64_t bytes);
  void send_heartbeat_to_all(std::uint32_t writer);
  void send_to_readers(PacketNumbers heartbeat, const std::vector<std::uint32_t>& readers);
  void send_acknack(Packet&& packet);
  void send_spdp_to_ports(std::uint32_t i);
  /// Base and bitmap of an ACKNACK.
  template <class World, class Sayings>
  static void fill(Packet& acknack, World& w, const Sayings& sayings) {
    acknack.detail = end_of(w.set_of(said_of<comp::BelowBase>(sayings)));
    acknack.descriptors = w.set_of(said_of<comp::Listed>(sayings));
  }
  /// One more than the greatest member.
  [[nodiscard]] static std::uint32_t end_of(const DescriptorSet& set) {
    return set.empty() ? 0 : set.highest() + 1;
  }

  // sender.cpp
  enum class SendMode : std::uint8_t { sync, async };
  [[nodiscard]] Message& message(SendMode mode) {
    return mode == SendMode::sync ? sync_message_ : async_message_;
  }
  void pack(Message& message, std::uint32_t writer, std::uint32_t d,
            const std::vector<std::uint32_t>& readers, SendMode mode);
  void charge(Message& message, std::int64_t submessage, SendMode mode);
  [[nodiscard]] bool is_used_up(const Message& message, std::int64_t submessage, SendMode mode);
  void count_sent(std::uint32_t i, std::int64_t bytes);
  void piggyback(Message& message, std::uint32_t writer, SendMode mode);
  void flush(Message& message, SendMode mode);
  void suspend(std::uint32_t i);
  void go_on(std::uint32_t i);

  // control.cpp
  void open(ControlSide side);
  void open_created(std::uint32_t i, Stream s, std::uint32_t d);
  void send_control(PacketKind kind, std::uint32_t relation, bool initial,
                    std::uint32_t last_sample);
  void count_control(std::uint32_t relation);
  void note_notified(std::uint32_t relation, std::uint32_t d);

  // lookups.cpp; `w` is a writer of questions or answers.
  [[nodiscard]] std::int64_t last_sample_bytes(std::uint32_t w) const;
  void pack_sample(std::uint32_t w, const std::vector<std::uint32_t>& readers);
  void charge_sample(std::uint32_t w);
  void send_samples(const Message& message);
  void send_lookup_heartbeats(std::uint32_t w);
  [[nodiscard]] bool has_samples(std::uint32_t w) const { return w >= first_lookup_writer_; }
  [[nodiscard]] std::uint32_t participant_of(std::uint32_t w) const {
    return has_samples(w) ? (w - first_lookup_writer_) / control_writers : w / 2;
  }
  /// A writer as rules number it.
  [[nodiscard]] std::uint32_t lookup_writer(std::uint32_t writer) const {
    return first_lookup_writer_ + writer;
  }
  [[nodiscard]] std::uint32_t samples_sent(std::uint32_t w) const {
    return static_cast<std::uint32_t>(at<lookup::SamplesSent>(w - first_lookup_writer_));
  }

  [[nodiscard]] bool is_created(std::uint32_t i, Stream s, std::uint32_t d) const {
    return d < first<rules::Exists>(static_cast<std::uint32_t>(2 * i + index_of(s)));
  }
  [[nodiscard]] bool crosses(std::uint32_t relation) const { return ends(relation).cross_host; }
  [[nodiscard]] std::uint32_t count_crossing(const std::vector<std::uint32_t>& relations) const {
    return static_cast<std::uint32_t>(
        std::ranges::count_if(relations, [this](std::uint32_t r) { return crosses(r); }));
  }

  const bool sends_records_;  // of HEARTBEATs to all readers of a writer
  Message sync_message_;
  Message async_message_;
  std::vector<std::uint32_t> targets_;
  Counts of_no_interest_;
  Counts& generated_;
};

template <class Host>
void Protocol::create(Host& host, const Event& event) {
  const auto [stream, d] = host.created_by(event);
  run_rule<comp::Happens<rules::Created>>(
      host, 2 * event.subject + static_cast<std::uint32_t>(index_of(stream)), nullptr, d);
}

template <class Host>
void Protocol::take_in(Host& host, const Packet& packet, std::uint32_t receiver) {
  const Topology& topology = host.topology();
  if (host.run_.now < topology.start(receiver)) return;
  comp::for_each_type(typename Host::Composition::Packets{}, [&]<class P>() {
    if (packet.kind != packet_kind_of<P>) return;
    if constexpr (std::is_same_v<P, comp::SpdpMulticast>) {
      run_rule<comp::Received<P>>(host, topology.pair_between(packet.pair, receiver), &packet);
    } else if constexpr (std::is_same_v<P, lookup::LookupSample>) {
      take_samples(packet, [&]<class Part>(Part, const Packet& part) {
        run_rule<comp::Received<Part>>(host, packet.detail, &part);
      });
    } else {
      if (std::is_same_v<P, rules::Data>) host.count_copies(host.bits(rules::C{}), packet);
      run_rule<comp::Received<P>>(host, number_of<P>(packet), &packet);
    }
  });
}

}  // namespace stormproof::model::fastdds
