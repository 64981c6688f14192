// What all implementations keep for the rules that they share (fsm/composition/reader.hpp,
// heartbeat_clock.hpp, announcements.hpp): the schedule of announcements, the reader side of every
// relation, and the HEARTBEAT clock of every writer with the cycle of the adaptive policy. It is
// the part of a host (model/engine/running_world.hpp) that is alike everywhere; how packets are
// filled and what a writer keeps of its readers is the implementation's own business.
#pragma once

#include <cstdint>
#include <vector>

#include "fsm/composition/announcements.hpp"
#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/reader.hpp"
#include "model/engine/network.hpp"
#include "model/engine/relation_bits.hpp"
#include "model/engine/running_world.hpp"
#include "model/engine/stored.hpp"

namespace stormproof::model {

/// How many descriptors the reader lacks, kept up to date.
struct Lacking : comp::Number<comp::owner::relation> {};
/// The rules that all implementations share.
using SharedThings =
    fsm::TypeList<comp::AnnouncementTimer, comp::Reader, comp::InitialTimer, comp::HeartbeatClock,
                  comp::Announcement, comp::AckNackGeneration, comp::InitialAttempt,
                  comp::HeartbeatExpiry, comp::CycleStart, comp::CycleEnd, comp::BatchDue,
                  comp::AnnouncementsSent, comp::HeartbeatSeen, comp::LastDelay, comp::CycleBegan,
                  comp::CyclePeriod, comp::Contacted, comp::Responded, comp::AnnouncedAtStart,
                  Lacking>;
struct SharedColumns : PlainColumns {
  using PlainColumns::column;
  static way::Narrow column(comp::AnnouncementsSent);
  static way::Prefix column(comp::AnnouncedAtStart);
  static way::Narrow column(Lacking);
  static way::Capped column(comp::LastDelay);
};

class DiscoveryBase : public Stored<DiscoveryBase, HostBase, SharedThings, SharedColumns,
                                    fsm::TypeList<comp::Contacted, comp::Responded>> {
 public:
  using Packet = model::Packet;

  DiscoveryBase(RunState& run, Network& network);

  // What only the host knows.
  using Stored::answer;
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::ContactedCount, const World& w) const {
    return cycles_[w.template number<comp::owner::writer>()].contacted;
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::RespondedCount, const World& w) const {
    return cycles_[w.template number<comp::owner::writer>()].responded;
  }
  [[nodiscard]] bool said(comp::CarriesHeartbeat, const Packet& packet) const {
    return packet.carries_heartbeat;
  }
  [[nodiscard]] bool said(comp::IsInitial, const Packet& packet) const {
    return packet.initial_acknack;
  }
  [[nodiscard]] bool said(comp::IsRepair, const Packet& packet) const { return packet.from_repair; }
  using Stored::word;
  [[nodiscard]] std::uint64_t word(comp::Carries, const Packet& packet, std::uint32_t k) const {
    return packet.descriptors.word(k);
  }
  [[nodiscard]] std::uint64_t word(comp::Listed, const Packet& packet, std::uint32_t k) const {
    return packet.descriptors.word(k);
  }

  // What is kept, and is more than a value.
  void changed(comp::Contacted, std::uint32_t relation, bool contacted) {
    auto& count = cycles_[writer_of(relation)].contacted;
    contacted ? ++count : --count;
  }
  void changed(comp::Responded, std::uint32_t relation, bool responded) {
    auto& count = cycles_[writer_of(relation)].responded;
    responded ? ++count : --count;
  }

  /// How many descriptors the reader lacks.
  template <class World>
  [[nodiscard]] std::uint32_t fact(comp::Missing, const World& w) const {
    return at<Lacking>(w.template number<comp::owner::relation>());
  }
  [[nodiscard]] std::vector<std::uint32_t> readers_by_number(std::uint32_t w) const {
    return open_relations(w);
  }

  // Packets and opaque steps.
  template <class World, class Sayings>
  void emit(comp::SpdpMulticast, World& w, const Sayings&) {
    send_spdp_multicast(w.template number<comp::owner::participant>());
  }
  template <class World, class Sayings>
  void emit(comp::SpdpUnicast, World& w, const Sayings&) {
    send_spdp_copy(w.template number<comp::owner::pair>());
  }
  template <class World>
  void perform(comp::CopyToKnown, World& w) {
    send_spdp_to_known(w.template number<comp::owner::participant>());
  }
  template <class World>
  void perform(comp::RefillBudget, World& w) {
    refill(w.template number<comp::owner::writer>());
  }
  /// The silent readers of the cycle are asked again, in batches spread over the rest of the
  /// stretched period.
  template <class World>
  void perform(comp::PlanBatches, World& w, std::int64_t stretched) {
    plan_batches(w.template number<comp::owner::writer>(), stretched);
  }

 protected:
  /// A HEARTBEAT to those readers of the next batch that still wait.
  template <class Rules, class World>
  void send_next_batch(World& w) {
    for (const std::uint32_t relation : next_batch(w.template number<comp::owner::writer>())) {
      RunningWorld<typename World::Host, comp::owner::relation> r{w.host(), relation};
      if (r(typename Rules::Waits{})) Rules::heartbeat(r);
    }
  }
  /// The readers whose turn it is in the next batch of the cycle.
  [[nodiscard]] std::vector<std::uint32_t> next_batch(std::uint32_t writer);
  /// The open relations of the writer, by number.
  [[nodiscard]] virtual std::vector<std::uint32_t> open_relations(std::uint32_t writer) const = 0;

  /// Announcement 0 of participant i.
  void start_announcing(std::uint32_t i) {
    run_.schedule(run_.topology.start(i), EventKind::announcement_due, i);
  }
  /// Counts the copies in a DATA that arrives.
  template <class Machine>
  void count_copies(const RelationBits<Machine>& bits, const Packet& data) {
    const std::uint32_t relation = data.relation();
    if (!ends(relation).cross_host) return;
    run_.duplicate_deliveries +=
        data.descriptors.count() - bits.count_missing(relation, data.descriptors);
  }
  /// The reader has these now, and perhaps they complete the run, which asks for those that are
  /// `required`.
  template <class Machine>
  void take(RelationBits<Machine>& bits, std::uint32_t relation, const DescriptorSet& received,
            bool required) {
    std::uint32_t& missing = at<Lacking>(relation);
    const std::uint32_t fresh =
        received.count() - (topology().descriptor_count(relation) - missing);
    if (required) {
      if (fresh > 0 && fresh == run_.missing) {
        note_last_delivery(relation, bits.missing(relation).lowest());
      }
      run_.missing -= fresh;
      run_.useful_deliveries += fresh;
    }
    bits.receive(relation, received);
    missing -= fresh;
  }

  /// What completes the run.
  void note_last_delivery(std::uint32_t relation, std::uint32_t descriptor);
  /// The reader has lost all that it had.
  template <class Machine>
  void lose(RelationBits<Machine>& bits, std::uint32_t relation, bool required) {
    std::uint32_t& missing = at<Lacking>(relation);
    const std::uint32_t all = topology().descriptor_count(relation);
    if (required) run_.missing += all - missing;
    bits.lose(relation);
    missing = all;
  }

  /// A unicast announcement to each participant that i knows.
  virtual void send_spdp_to_known(std::uint32_t i) = 0;
  virtual void send_spdp_multicast(std::uint32_t i) = 0;
  /// A unicast announcement from the pair's source to its destination.
  virtual void send_spdp_copy(std::uint32_t pair) = 0;
  /// The piggyback budget of the writer is full again.
  virtual void refill(std::uint32_t writer) = 0;

  [[nodiscard]] static Packet packet_of(PacketKind kind, std::uint32_t pair,
                                        std::int64_t payload_bytes);
  [[nodiscard]] static Packet packet_on(PacketKind kind, std::uint32_t relation,
                                        std::int64_t payload_bytes);

  [[nodiscard]] const Pair& ends(std::uint32_t relation) const {
    return run_.topology.pair(relation / 2);
  }
  [[nodiscard]] std::uint32_t writer_of(std::uint32_t relation) const {
    return 2 * ends(relation).source + relation % 2;
  }
  [[nodiscard]] static Stream stream_of(std::uint32_t relation_or_writer) {
    return relation_or_writer % 2 == 0 ? Stream::pub : Stream::sub;
  }

  Network& network_;

  /// The cycle of the adaptive policy.
  struct Cycle {
    std::uint32_t contacted = 0;
    std::uint32_t responded = 0;
    std::vector<std::vector<std::uint32_t>> batches;
    std::size_t next_batch = 0;
  };
  std::vector<Cycle> cycles_;  // by writer

 private:
  void plan_batches(std::uint32_t writer, std::int64_t stretched);
};

}  // namespace stormproof::model
